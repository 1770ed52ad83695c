#include "rehearse/identification/fit_problem.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "learn_swing.hpp"

namespace rehearse::identification {
namespace {

using swing::failing_above, swing::learn_swing;

TEST(FitProblem, ARefitKeepsPhiAndFindsAKernelForEachOutput) {
  const Dataset data = swing::data(30, 1);
  const dynamics::Residuals residuals(data, swing::features());
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const FitProblem problem{residuals, &prior, Score::product, {}, serial_evaluator()};
  const Vector phi{{0.9, 0.2}};
  Fit fit = unfitted(phi, 2, {});
  EXPECT_EQ(fit.kernels.front().hyperparameters.inputs(), 0);
  problem.refit(fit);
  EXPECT_EQ(fit.phi, phi);
  EXPECT_EQ(fit.left_out, 0);
  EXPECT_EQ(hyperparameters(fit).back().inputs(), 4);
  EXPECT_NEAR(fit.score, fit.log_evidences.sum(), 1e-9 * std::abs(fit.score));
  const double first = fit.score;
  problem.refit(fit);
  EXPECT_GE(fit.score, first - 1e-9) << "from where it was";
}

TEST(FitProblem, ARowThatFailsCostsWhatTheSpreadOfTheChangesWouldSay) {
  const Dataset data = swing::data(30, 1);
  const dynamics::Residuals residuals(data, swing::features());
  const FitProblem problem{residuals, nullptr, Score::product, {}, serial_evaluator()};
  const Vector evidences{{10, 20}};
  const double spread = residuals.scale().array().log().sum();
  EXPECT_NEAR(problem.charged_score(evidences, 3), 30 - 3 * (1 + spread + std::log(2 * M_PI)), 1e-9);
}

TEST(FitProblem, LeavesOutAndCountsRowsThatFail) {
  const Dataset data = swing::data(60, 1);
  const prior::Prior prior = failing_above(2, {swing::length(), swing::friction()});
  Matrix mean(60, 2);
  const Index failing = prior.mean(data.states, data.actions, swing::kTruth, mean);
  ASSERT_GT(failing, 3);
  for (const Kind& kind : {Kind(FixedPrior{}), Kind(GpMi{}), Kind(Mi{})}) {
    const Learned learned = learn_swing(data, kind, &prior);
    EXPECT_NEAR(learned.left_out_rows, failing, 3);  // near the limit it depends on φ
    if (std::holds_alternative<FixedPrior>(kind)) continue;
    EXPECT_NEAR((*learned.state.phi)(0), 0.8, 0.016);
  }
}

// A clock, say: its changes do not vary, and a row that fails must not earn what its density would be.
TEST(FitProblem, AStateThatChangesEvenlyDoesNotRewardFailures) {
  Dataset data = swing::data(60, 1);
  data.changes.col(1).setConstant(0.1);
  const auto clock = [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    swing::ode(x, u, phi, dxdt);
    dxdt(1) = 1;
    if (phi(0) < 1 && x(0) > 0) dxdt(0) = kNaN;
  };
  const prior::Prior prior = swing::prior({Parameter::discrete("length", 0.5, {0.5, 1.2}), swing::friction()}, clock);
  const Learned learned = learn_swing(data, GpMi{}, &prior);
  EXPECT_EQ((*learned.state.phi)(0), 1.2);
  EXPECT_EQ(learned.left_out_rows, 0);
}

// The shorter swing is the worse one, but can be simulated only where gravity hardly pulls: there it predicts well.
TEST(FitProblem, AParameterDoesNotWinByFailingWhereItIsWrong) {
  const auto fragile = [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    swing::ode(x, u, phi, dxdt);
    if (phi(0) < 1 && std::abs(std::sin(x(1))) > 0.4) dxdt(0) = kNaN;
  };
  const prior::Prior prior = swing::prior({Parameter::discrete("length", 0.5, {0.5, 1.2}), swing::friction()}, fragile);
  for (const Kind& kind : {Kind(GpMi{}), Kind(Mi{})}) {
    const Learned learned = learn_swing(swing::data(60, 1), kind, &prior);
    EXPECT_EQ((*learned.state.phi)(0), 1.2) << kind.index();
    EXPECT_EQ(learned.left_out_rows, 0);
  }
}

TEST(FitProblem, WhatServosTellIsNotLearned) {
  Kinematics behind_servo{.dt_s = 0.1};
  behind_servo.servos.push_back({.action = 0, .position = 1});
  const Dataset data = swing::data(30, 1);
  const dynamics::Residuals residuals(data, swing::features(), behind_servo);
  const FitProblem problem{residuals, nullptr, Score::product, {}, serial_evaluator()};
  Fit fit = unfitted({}, 2, {});
  problem.refit(fit);
  EXPECT_EQ(fit.log_evidences(1), 0);
  EXPECT_EQ(fit.score, fit.log_evidences(0));
  EXPECT_EQ(hyperparameters(fit).back().inputs(), 4);
}

}  // namespace
}  // namespace rehearse::identification
