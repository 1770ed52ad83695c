#include "rehearse/rollout/simulation.hpp"

#include <gtest/gtest.h>

#include "cart.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/test_tools.hpp"

namespace rehearse::rollout {
namespace {

TEST(CheckSimulation, RefusesPartsThatDoNotFit) {
  Task task = cart::task();
  const auto policy = cart::policy();
  const cart::Model model;
  const Index parameters = policy->parameters();
  const auto refusal = [&](Index given, Index particles) {
    return message_of<InvalidInput>([&] { check_simulation({model, *policy, task}, given, particles); });
  };
  EXPECT_NO_THROW(check_simulation({model, *policy, task}, parameters, 1));
  EXPECT_EQ(refusal(parameters - 1, 1), "theta has 12 numbers, must have the 13 of the policy 'mlp'");
  EXPECT_EQ(refusal(parameters, 0), "particles = 0, must be ≥ 1");
  task.actions.push_back(task.actions.front());
  EXPECT_EQ(refusal(parameters, 1), "the policy 'mlp' has 1 actions, must have the 2 of the task");
}

TEST(RowsAtOnce, AreThoseOfTheDearer) {
  Task task = cart::task();
  const cart::Model model;
  EXPECT_EQ(rows_at_once(model, task), 0);
  task.rows_at_once = 7;
  EXPECT_EQ(rows_at_once(model, task), 7);
}

TEST(RowsOfChunk, AreMoreWhereCallsAreDear) {
  EXPECT_EQ(rows_of_chunk(1000, 64, 0), 64);
  EXPECT_EQ(rows_of_chunk(10, 64, 0), 10);
  EXPECT_EQ(rows_of_chunk(1000, 64, 10000), 1000);
  EXPECT_EQ(rows_of_chunk(1000, 64, 2000), 500);
  EXPECT_EQ(rows_of_chunk(1000, 64, 100), 100);
  EXPECT_EQ(groups_of_chunk(100, 5, 4, 0), 4);
  EXPECT_EQ(groups_of_chunk(100, 5, 4, 102), 20);
  EXPECT_EQ(groups_of_chunk(100, 500, 1, 100), 1);
  EXPECT_EQ(groups_of_chunk(0, 5, 4, 100), 1);
}

TEST(SimulateOptions, AreNamedWithTheirBounds) {
  SimulateOptions options{.noise_clip = -1, .measurement_noise = -2};
  EXPECT_EQ(field_violations([&](FieldVisitor& v) { options.fields(v); }).size(), 2U);
  options = {};
  EXPECT_TRUE(field_violations([&](FieldVisitor& v) { options.fields(v); }).empty());
}

}  // namespace
}  // namespace rehearse::rollout
