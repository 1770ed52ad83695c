#include "rehearse/lqr/hold.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "pendulum.hpp"

namespace rehearse::lqr {
namespace {

/// x' = (A + B K) x, with A = (1, dt; dt, 1): both eigenvalues are within the unit circle.
void expect_stable(const Matrix& gain) {
  const double trace = 2 + line::kDt * gain(0, 1),
               determinant = 1 + line::kDt * gain(0, 1) - line::kDt * line::kDt * (1 + gain(0, 0));
  EXPECT_LT(std::abs(trace), 1 + determinant);
  EXPECT_LT(determinant, 1);
}

TEST(Hold, IsWhereTheRobotStaysAndEarnsMost) {
  const Task task = upright::task(2, 0);
  const upright::Model model;
  const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 1e-3});
  const auto hold = find_hold({model, task, serial_evaluator()}, costs, Vector{{0.2, 0.5}}, Vector{{0.4}}, 0);
  ASSERT_TRUE(hold);
  EXPECT_NEAR(hold->stage.state.norm(), 0, 1e-5);
  EXPECT_NEAR(hold->stage.action(0), 0, 1e-5);
  expect_stable(hold->stage.gain);
}

TEST(Hold, MayNeedAnAction) {
  const Task task = upright::task(2, 0.5);
  const upright::Model model;
  const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 1e-6});
  const auto hold = find_hold({model, task, serial_evaluator()}, costs, Vector{{0.2, 0.5}}, Vector{{0}}, 0);
  ASSERT_TRUE(hold);
  EXPECT_NEAR(hold->stage.state(0), 0.5, 1e-3);
  EXPECT_NEAR(hold->stage.action(0), -std::sin(0.5), 1e-3);
}

TEST(Hold, IsNotThereWhereTheActionsAreTooWeak) {
  const Task task = upright::task(0.1, 1.2);
  const upright::Model model;
  const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 1e-6});
  EXPECT_FALSE(find_hold({model, task, serial_evaluator()}, costs, Vector{{1.2, 0}}, Vector{{0}}, 0));
}

TEST(CheapestHold, IsTheBestOfThoseThatAreThere) {
  const upright::Model model;
  const auto from = [&](const Task& task, const Matrix& states) {
    const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 1e-3});
    return find_cheapest_hold({model, task, serial_evaluator()}, costs, states, Matrix::Zero(states.rows(), 1), 0);
  };
  const Task task = upright::task(2, 0);
  const auto hanging = from(task, Matrix{{3.1, 0}});
  ASSERT_TRUE(hanging);
  EXPECT_GT(std::abs(hanging->stage.state(0)), 2);
  for (const Matrix& both : {Matrix{{3.1, 0}, {0.2, 0.5}}, Matrix{{0.2, 0.5}, {3.1, 0}}}) {
    const auto best = from(task, both);
    ASSERT_TRUE(best);
    EXPECT_NEAR(best->stage.state.norm(), 0, 1e-5);
  }
  EXPECT_FALSE(from(task, Matrix(0, 2)));
  EXPECT_FALSE(from(upright::task(0.1, 1.2), Matrix{{1.2, 0}})) << "the actions are too weak";
}

TEST(Hold, KnowsItsActionBeforeAndTheTime) {
  Task task = upright::task(2, 0.5);
  const upright::Model model;
  const auto hold = [&](double time_s) {
    const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 1e-6});
    return find_hold({model, task, serial_evaluator()}, costs, Vector{{0.2, 0.5}}, Vector{{0}}, time_s);
  };
  task.cost = [](const Steps& steps, VectorView costs) {
    costs = 5 * (steps.U - steps.U_before).rowwise().squaredNorm();
  };
  ASSERT_TRUE(hold(3));
  EXPECT_NEAR(hold(3)->stage.state(0), 0.5, 1e-3) << "an action that stays costs nothing";
  task.cost = [](const Steps& steps, VectorView costs) {
    costs = (steps.time_s > 2 ? 5 : 0) * steps.U.rowwise().squaredNorm();
  };
  ASSERT_TRUE(hold(3));
  EXPECT_LT(std::abs(hold(3)->stage.state(0)), 0.3) << "where less action is needed";
}

TEST(Hold, IsStableWithoutTheActionBefore) {
  Task task = upright::task(2, 0);
  const upright::Model model;
  for (const double weight : {0.1, 1.0, 10.0, 100.0}) {
    task.cost = [weight](const Steps& steps, VectorView costs) {
      costs = weight * (steps.U - steps.U_before).rowwise().squaredNorm();
    };
    const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 1e-3});
    const auto hold = find_hold({model, task, serial_evaluator()}, costs, Vector{{0.1, 0}}, Vector{{0}}, 0);
    ASSERT_TRUE(hold) << weight;
    expect_stable(hold->stage.gain);
    EXPECT_EQ(hold->value.S.rows(), 3) << "by the action before, too";
  }
}

TEST(Hold, IsNotOfStatesThatAPolicyDoesNotSee) {
  Task task = line::task();
  const line::Model model;
  const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 0.1});
  const auto hold = [&] {
    return find_hold({model, task, serial_evaluator()}, costs, Vector{{0.5, 0}}, Vector{{0}}, 0);
  };
  EXPECT_TRUE(hold());
  task.states[0].kind = StateKind::omitted;
  EXPECT_FALSE(hold()) << "the place decides the reward";
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& next, VectorView rewards) {
    rewards = -next.col(1).cwiseAbs2();
  };
  ASSERT_TRUE(hold());
  EXPECT_EQ(hold()->stage.gain(0, 0), 0);
}

}  // namespace
}  // namespace rehearse::lqr
