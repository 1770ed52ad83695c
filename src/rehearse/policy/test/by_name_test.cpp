#include "rehearse/policy/by_name.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/test_tools.hpp"
#include "rehearse/policy/hand_over.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/policy/schedule.hpp"
#include "rehearse/policy/tracking.hpp"

namespace rehearse::policy {
namespace {

TEST(ByName, PoliciesHaveTheNamesThatTheyAreFoundBy) {
  Task task;
  task.states = {{"x", "m"}};
  task.actions = {{"u", "N", {-1, 1}}};
  task.start_mean = task.start_std = Vector::Zero(1);
  task.dt_s = 0.1;
  task.horizon = 5;
  const std::shared_ptr<const Policy> own =
      make_linear({.features = task.feature_map(), .scale = Vector::Ones(1), .squash = {{{-1, 1}}, 1}});
  EXPECT_EQ(by_name(own->name(), own->parameters(), task, own), own);
  for (const auto& policy : {make_schedule(task), make_hand_over(task, own), make_tracking(task, 4)}) {
    const auto found = by_name(policy->name(), policy->parameters(), task, own);
    EXPECT_EQ(found->name(), policy->name());
    EXPECT_EQ(found->parameters(), policy->parameters());
  }
  EXPECT_NE(message_of<InvalidInput>([&] {
              by_name("gait", 1, task, own);
            }).find("the policy 'gait' is neither the scenario's"),
            std::string::npos);
}

}  // namespace
}  // namespace rehearse::policy
