#include "rehearse/lqr/step_costs.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "line.hpp"

namespace rehearse::lqr {
namespace {

TEST(StepCosts, AreMinusTheRewardOrItsLogarithm) {
  Task task = line::task(4);
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& next, VectorView rewards) {
    rewards = (-next.col(0).array().square()).exp();
  };
  const Matrix W{{0, 0, 2, 1.5, 0}, {0, 0, -4, kNaN, 0}};  // state, action, state reached
  Vector costs(2);
  StepCosts(task, {.scale = CostScale::linear, .action_cost = 0.1}).evaluate(W, Vector::Zero(2), costs);
  EXPECT_NEAR(costs(0), -std::exp(-2.25) + 0.1 * 0.25, 1e-14);
  EXPECT_EQ(costs(1), kInf);
  StepCosts(task, {.scale = CostScale::logarithmic, .action_cost = 0.1}).evaluate(W, Vector::Zero(2), costs);
  EXPECT_NEAR(costs(0), 2.25 + 0.1 * 0.25, 1e-14);
}

TEST(StepCosts, OfStayingAreThoseOfAStepThatLeadsBack) {
  const Task task = line::task(4);
  const Vector costs = StepCosts(task, {.scale = CostScale::linear, .action_cost = 0.1})
                           .of_staying(Matrix{{3, 1}, {0, 0}}, Matrix{{2}, {0}}, 0);
  EXPECT_NEAR(costs(0), 9 + 0.1 + 0.025, 1e-12);
  EXPECT_EQ(costs(1), 0);
}

TEST(StepCosts, ExpandQuadraticsExactly) {
  const Task task = line::task(4);
  const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 0.1});
  const Matrix W{{3, 1, 2, 1.5, -2}, {1, 1, 0, 0, 0}};
  const auto all = costs.expand(W, Vector::Zero(2));
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NEAR(all[0].value, 2.25 + 0.4 + 0.025, 1e-12);
  EXPECT_TRUE(all[0].gradient.isApprox(Vector{{0, 0, 0.1, 3, -0.4}}, 1e-6)) << all[0].gradient;
  EXPECT_TRUE(all[0].hessian.isApprox(Matrix(Vector{{0, 0, 0.2, 2, 0.2}}.asDiagonal()), 1e-5)) << all[0].hessian;
}

TEST(StepCosts, LeaveOutNegativeCurvature) {
  Task task = line::task(4);
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& next, VectorView rewards) {
    rewards = next.col(0).cwiseProduct(next.col(1));
  };
  const Matrix hessian = StepCosts(task, {.scale = CostScale::linear, .action_cost = 0.1})
                             .expand(Matrix{{0, 0, 0, 1, 1}}, Vector::Zero(1))[0]
                             .hessian;
  EXPECT_TRUE(hessian.bottomRightCorner(2, 2).isApprox(Matrix{{0.5, -0.5}, {-0.5, 0.5}}, 1e-5)) << hessian;
}

TEST(StepCosts, KnowTheActionBeforeAndTheTime) {
  Task task = line::task(2);
  task.cost = [](const Steps& steps, VectorView costs) {
    costs = steps.time_s * (steps.U - steps.U_before).col(0).cwiseAbs2();
  };
  const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 0.1});
  ASSERT_EQ(costs.columns().planner_state(), 3);
  const Matrix W{{0, 0, 1, 2, 0, 0}, {0, 0, 0, 2, 0, 0}};  // state, action before, action, state reached
  const auto all = costs.expand(W, Vector{{0.5, 3}});
  EXPECT_NEAR(all[0].value, 0.5 + 0.1, 1e-12);
  EXPECT_NEAR(all[1].value, 12 + 0.1, 1e-12);
  EXPECT_NEAR(all[1].gradient(2), -3 * 4 * 2, 1e-4) << "actions are in units of half their range";
  EXPECT_NEAR(all[1].gradient(3), 3 * 4 * 2 + 0.2, 1e-4);
  EXPECT_NEAR(costs.of_staying(Matrix::Zero(1, 2), Matrix{{2}}, 3)(0), 0.1, 1e-12) << "its action does not change";
  task.cost = [](const Steps& steps, VectorView c) { c.setConstant(steps.time_s > 2 ? 7 : 0); };
  EXPECT_NEAR(costs.of_staying(Matrix::Zero(1, 2), Matrix{{0}}, 3)(0), 7, 1e-12);
}

}  // namespace
}  // namespace rehearse::lqr
