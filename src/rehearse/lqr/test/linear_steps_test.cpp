#include "rehearse/lqr/linear_steps.hpp"

#include <gtest/gtest.h>

#include "line.hpp"

namespace rehearse::lqr {
namespace {

TEST(LinearSteps, AreTheModelInUnitsOfHalfTheActionsRange) {
  const Task task = line::task(4);
  const line::Model model(0.5);
  const Problem problem{model, task, serial_evaluator()};
  Trajectory trajectory;
  trajectory.states = Matrix{{1, 0}, {1, 0.2}};
  trajectory.actions = Matrix{{2}};
  trajectory.steps = 1;
  dynamics::Linearised at;
  const auto steps =
      planned_steps(problem, StepCosts(task, {.scale = CostScale::linear, .action_cost = 0.1}), trajectory, at);
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_TRUE(steps[0].dynamics.by.isApprox(Matrix{{1, 0.1, 0}, {0, 1, 0.4}}, 1e-8)) << steps[0].dynamics.by;
  EXPECT_TRUE(steps[0].dynamics.variance.isApprox(Vector{{1, 1}}));
  EXPECT_TRUE(steps[0].dynamics.variance_by.isApprox(Matrix{{1, 0, 0}, {1, 0, 0}}, 1e-8));
  EXPECT_EQ(steps[0].action(0), 0.5);
}

TEST(LinearSteps, RememberTheActionWhereACostNeedsIt) {
  Task task = line::task(4);
  task.cost = [](const Steps& steps, VectorView costs) { costs = (steps.U - steps.U_before).col(0).cwiseAbs2(); };
  const line::Model model;
  const Problem problem{model, task, serial_evaluator()};
  Trajectory trajectory;
  trajectory.states = Matrix{{1, 0}, {1, 0.2}, {1, 0.3}};
  trajectory.actions = Matrix{{2}, {1}};
  trajectory.steps = 2;
  const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 0.1});
  EXPECT_EQ(trajectory.rows(costs.columns()).col(2), (Vector{{0, 2}})) << "the actions before";
  dynamics::Linearised at;
  const auto steps = planned_steps(problem, costs, trajectory, at);
  EXPECT_TRUE(steps[1].dynamics.by.isApprox(Matrix{{1, 0.1, 0, 0}, {0, 1, 0, 0.4}, {0, 0, 0, 1}}, 1e-8));
}

}  // namespace
}  // namespace rehearse::lqr
