#include "rehearse/rollout/step_slopes.hpp"

#include <gtest/gtest.h>

namespace rehearse::rollout {
namespace {

TEST(StepSlopes, AreThoseOfRewardLessCost) {
  Task task;
  task.reward = [](const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& X_next, VectorView r) {
    r = X.col(0).array() * U.col(0).array() + X_next.col(1).array().cube();
  };
  const Matrix X{{1, 2}, {3, -4}}, U{{5}, {6}}, X_next{{7, 8}, {-9, 1}}, before{{0.5}, {-0.5}};
  Matrix by;
  step_slopes(task, {X, U, X_next, Matrix(), 0}, by);
  EXPECT_LT((by - Matrix{{5, 0, 1, 0, 3 * 64}, {6, 0, 3, 0, 3}}).cwiseAbs().maxCoeff(), 1e-6) << by;
  task.cost = [](const Steps& steps, VectorView c) { c = steps.time_s * steps.U.cwiseProduct(steps.U_before).col(0); };
  step_slopes(task, {X, U, X_next, before, 2}, by);
  EXPECT_LT((by - Matrix{{5, 0, 1 - 1, 0, 3 * 64, -10}, {6, 0, 3 + 1, 0, 3, -12}}).cwiseAbs().maxCoeff(), 1e-6) << by;
}

TEST(StepSlopes, KnowDifferencesOfActions) {
  Task task;
  task.reward = [](const ConstMatrixView&, const ConstMatrixView& U, const ConstMatrixView&, VectorView r) {
    r = U.col(0) - U.col(1);
  };
  const Matrix X{{1}}, U{{0.5, -0.25}}, before{{-0.5, 0.75}};
  Matrix by;
  step_slopes(task, {X, U, X, Matrix(), 0}, by);
  EXPECT_LT((by - Matrix{{0, 1, -1, 0}}).cwiseAbs().maxCoeff(), 1e-9) << by;
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView r) {
    r.setZero();
  };
  task.cost = [](const Steps& steps, VectorView c) { c = (steps.U - steps.U_before).rowwise().squaredNorm(); };
  step_slopes(task, {X, U, X, before, 0}, by);
  EXPECT_LT((by - Matrix{{0, -2, 2, 0, 2, -2}}).cwiseAbs().maxCoeff(), 1e-9) << by;
}

TEST(StepSlopes, ARowThatIsNotFiniteDisturbsNoOther) {
  Task task;
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& X_next, VectorView r) {
    r = X_next.col(0);
  };
  const Matrix X{{1}, {2}}, U{{0}, {0}}, X_next{{kNaN}, {3}};
  Matrix by;
  step_slopes(task, {X, U, X_next, Matrix(), 0}, by);
  EXPECT_TRUE(std::isnan(by(0, 2)));
  EXPECT_NEAR(by(1, 2), 1, 1e-9);
  EXPECT_EQ(by(1, 0), 0);
}

}  // namespace
}  // namespace rehearse::rollout
