#include "rehearse/learners/black_drops/search_problem.hpp"

#include <algorithm>

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
                       {.selection = 30, .safety = {.rollouts = 80}});
  };
  EXPECT_EQ(number(sure), 30) << "starts differ";
  task.start_std.setZero();
  EXPECT_EQ(number(sure), 1);
  EXPECT_EQ(number(uncertain), 30);
  task.limits.emplace_back();
  EXPECT_EQ(number(sure), 80);
  task.limits[0].risk = 0.01;
  EXPECT_EQ(number(sure), 368) << "none of 367 may be chance";
}

/// An episode of the slider whose positions are given.
Episode through(std::initializer_list<double> positions) {
  const auto n = static_cast<Index>(positions.size());
  Episode episode{.states = Matrix(n, 1), .actions = Matrix::Zero(n - 1, 1), .rewards = Vector::Zero(n - 1)};
  std::copy(positions.begin(), positions.end(), episode.states.data());
  episode.true_states = episode.states;
  return episode;
}

TEST(Continued, IsSolvedByTheFirstStepsAndByTheLast) {
  Task task = slider::task();
  task.horizon = 2, task.dt_s = 0.1;
  task.solved = [](const Episode& e) { return e.steps() == 2 && e.states(2, 0) > 0; };
  EXPECT_EQ(continued(task, 0).horizon, 2);
  EXPECT_TRUE(continued(task, 0).solved(through({0, 0, 1})));
  const Task longer = continued(task, 0.3);
  EXPECT_EQ(longer.horizon, 5);
  EXPECT_TRUE(longer.solved(through({0, 0, 1, 0, 0, 1})));
  EXPECT_FALSE(longer.solved(through({0, 0, 1, 1, 1, 0}))) << "it falls afterwards";
  EXPECT_FALSE(longer.solved(through({0, 0, 0, 1, 1, 1}))) << "it is late";
  Episode fallen = through({0, 0, 1, 1});
  fallen.ended = true;
  EXPECT_FALSE(longer.solved(fallen));
  task.solved = {};
  EXPECT_FALSE(continued(task, 0.3).solved);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
