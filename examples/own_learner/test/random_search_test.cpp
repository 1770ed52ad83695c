#include "../random_search.hpp"

#include <gtest/gtest.h>

#include "rehearse/learners/test/slider.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/testing/check_learner.hpp"

namespace rehearse::learners::random_search {

TEST(RandomSearch, KeepsTheLaws) {
  const Task task = slider::task();
  const Setting setting{.task = task,
                        .policy = policy::make_linear({task.feature_map(), Vector{{1}}, {task.action_bounds(), 1}}),
                        .prior = slider::prior()};
  EXPECT_EQ(testing::check_learner(*builders().front(), setting, slider::run_trial), std::vector<std::string>{});
}

}  // namespace rehearse::learners::random_search
