#include "rehearse/lqr/backward_pass.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::lqr {
namespace {

/// y' = 2y + u, cost ½ (y'² + u²), planned at y = y' = u = 0 but for a slope of the cost by y'.
PlannedStep step(double slope = 0, double action = 0) {
  return {.dynamics = {.by = Matrix{{2, 1}}, .variance = Vector::Zero(1), .variance_by = Matrix::Zero(1, 2)},
          .cost = {.value = 0, .gradient = Vector{{0, 0, slope}}, .hessian = Matrix{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
          .action = Vector{{action}}};
}

const Value kNothing{Vector::Zero(1), Matrix::Zero(1, 1)};

TEST(BackwardPass, IsRiccatisRecursion) {
  const auto one = backward_step(step(), {Vector::Zero(1), Matrix{{3}}}, 0, 0);
  ASSERT_TRUE(one);
  // u = −(1 + 1 + 3)⁻¹ (1 + 3) 2 y; the cost to go: 4 (1 + 3) − 8² / 5.
  EXPECT_NEAR(one->feedback.gain(0, 0), -8.0 / 5, 1e-12);
  EXPECT_NEAR(one->before.S(0, 0), 16 - 64.0 / 5, 1e-12);
  EXPECT_EQ(one->feedback.open(0), 0);
}

TEST(BackwardPass, OfAStepForEverEndsWhereItsRecursionDoes) {
  const auto found = repeated_step(step());
  ASSERT_TRUE(found);
  const auto again = backward_step(step(), found->before, 0, 0);
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->before.S(0, 0), found->before.S(0, 0), 1e-8);
  EXPECT_NEAR(again->feedback.gain(0, 0), found->feedback.gain(0, 0), 1e-8);
  EXPECT_LT(std::abs(2 + found->feedback.gain(0, 0)), 1) << "stable, which the step is not";
  PlannedStep idle = step();
  idle.dynamics.by = Matrix{{2, 0}};
  EXPECT_FALSE(repeated_step(idle)) << "no action moves it";
}

TEST(BackwardPass, FollowsTheSlope) {
  const auto one = backward_step(step(0.4), kNothing, 0, 0);
  ASSERT_TRUE(one);
  EXPECT_NEAR(one->feedback.open(0), -0.2, 1e-12);
  EXPECT_NEAR(one->before.s(0), 0.8 - 2 * 0.4 / 2, 1e-12) << "the action takes half of it";
}

TEST(BackwardPass, KeepsTheBounds) {
  const auto one = backward_step(step(5, 0.5), kNothing, 0, 0);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->feedback.open(0), -1.5) << "the action is at −1";
  EXPECT_EQ(one->feedback.gain(0, 0), 0) << "no feedback can move it further";
}

TEST(BackwardPass, DampingMakesStepsSmaller) {
  EXPECT_NEAR(backward_step(step(0.4), kNothing, 2, 0)->feedback.open(0), -0.1, 1e-12);
}

TEST(BackwardPass, AvoidsWhatTheModelDoesNotKnow) {
  PlannedStep unsure = step();
  unsure.dynamics.variance = Vector{{0.5}};
  unsure.dynamics.variance_by = Matrix{{0.2, 0.4}};
  const Value after{Vector::Zero(1), Matrix{{3}}};
  const auto one = backward_step(unsure, after, 0, 1);
  ASSERT_TRUE(one);
  // The costs that follow and the step's own have the curvature 4 at the next state. Half of 4 V has the slopes 0.4 and
  // 0.8; its curvature by u is 4 · 0.4² / (4 · 0.5).
  EXPECT_NEAR(one->feedback.open(0), -0.8 / (5 + 0.32), 1e-12);
  EXPECT_EQ(backward_step(unsure, after, 0, 0)->feedback.open(0), 0);
}

TEST(BackwardPass, AvoidsUncertaintyOfTheStateThatItsOwnCostLooksAt) {
  // x' = u with the variance 4 u², and a cost of (x' − 1)² / 2: expected to be (u − 1)² / 2 + 2 u², least at 0.2.
  const double u = 0.2;
  PlannedStep own{
      .dynamics = {.by = Matrix{{0, 1}}, .variance = Vector{{4 * u * u}}, .variance_by = Matrix{{0, 8 * u}}},
      .cost = {.value = 0, .gradient = Vector{{0, 0, u - 1}}, .hessian = Matrix::Zero(3, 3)},
      .action = Vector{{u}}};
  own.cost.hessian(2, 2) = 1;
  EXPECT_NEAR(backward_step(own, kNothing, 0, 1)->feedback.open(0), 0, 1e-12);
  EXPECT_NEAR(backward_step(own, kNothing, 0, 0)->feedback.open(0), 0.8, 1e-12);
  EXPECT_EQ(curvature_at_next(own, {Vector::Zero(1), Matrix{{3}}}, 0), 4);
}

TEST(BackwardPass, SaysWhereThereIsNoMinimum) {
  PlannedStep hill = step();
  hill.cost.hessian(1, 1) = -3;
  EXPECT_FALSE(backward_step(hill, kNothing, 0, 0));
  EXPECT_TRUE(backward_step(hill, kNothing, 10, 0)) << "damping makes it one";
  hill.cost.gradient(0) = kNaN;
  EXPECT_FALSE(backward_step(hill, kNothing, 10, 0));
}

TEST(BackwardPass, GoesFromTheEndToTheBeginning) {
  const auto pass = backward_pass({step(), step(0.4)}, kNothing, 0, 0);
  ASSERT_TRUE(pass);
  ASSERT_EQ(pass->feedback.size(), 2U);
  const auto last = backward_step(step(0.4), kNothing, 0, 0), first = backward_step(step(), last->before, 0, 0);
  EXPECT_EQ(pass->feedback[1].open, last->feedback.open);
  EXPECT_EQ(pass->feedback[0].open, first->feedback.open);
  EXPECT_EQ(pass->values[0].S, first->before.S);
}

}  // namespace
}  // namespace rehearse::lqr
