#include "rehearse/learners/black_drops/search_problem.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/simulator_model.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

TEST(Comparisons, AreOneWhereNothingCanDiffer) {
  Task task = slider::task();
  const dynamics::SimulatorModel sure(slider::prior(), slider::kTruth),
      uncertain(slider::prior(), slider::kTruth, 0.01);
  const auto policy = slider::policy();
  const ProgressSink nobody;
  const auto number = [&](const dynamics::DynamicsModel& model) {
    return comparisons({model, *policy, task, serial_evaluator(), nobody},
                       {.selection = 30, .safety = {.rollouts = 50}});
  };
  EXPECT_EQ(number(sure), 30) << "starts differ";
  task.start_std.setZero();
  EXPECT_EQ(number(sure), 1);
  EXPECT_EQ(number(uncertain), 30);
  task.limits.emplace_back();
  EXPECT_EQ(number(sure), 50);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
