#include "rehearse/lqr/region.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "pendulum.hpp"
#include "rehearse/rollout/forecast.hpp"

namespace rehearse::lqr {
namespace {

const StreamKey kOfRegions{.seed = 3, .stage = Stage::goal};

std::optional<Region> region_of(const Task& task, const dynamics::DynamicsModel& model,
                                const Evaluator& evaluator = serial_evaluator()) {
  return widest_region({model, task, evaluator}, Vector::Zero(2), Vector::Zero(1), kOfRegions);
}

/// How many of 200 states in the region, as far out as `stretch` times its surface, come back.
Index returning(const Task& task, const dynamics::DynamicsModel& model, const policy::HandOver& hand_over,
                double stretch) {
  Rng rng({.seed = 9});
  Matrix states(200, 2);
  const Eigen::LLT<Matrix> factor(hand_over.shape);
  for (Index i = 0; i < 200; ++i) {
    const double angle = rng.uniform(0, 2 * std::numbers::pi);
    states.row(i) = stretch * factor.matrixU().solve(Vector{{std::cos(angle), std::sin(angle)}}).transpose();
  }
  const auto feedback = policy::make_tracking(task, 2);
  const Vector theta = policy::to_theta({hand_over.feedback, hand_over.feedback});
  const Matrix arrived = rollout::follow(model, task, {*feedback, theta}, states, 3 * task.horizon);
  return (arrived.rowwise().norm().array() < 0.1).count();
}

TEST(Region, IsWhereFeedbackBringsTheRobotBack) {
  const Task task = upright::task(0.3, 0);  // it can hold itself up to an angle of 0.3
  const upright::Model model;
  const auto region = region_of(task, model);
  ASSERT_TRUE(region);
  EXPECT_GE(returning(task, model, region->hand_over, 0.95), 190);
  EXPECT_LT(returning(task, model, region->hand_over, 1.3), 180) << "it is the largest one";
}

TEST(Region, IsLargerWhereActionsAreStronger) {
  const upright::Model model;
  const Task weak = upright::task(0.3, 0), strong = upright::task(0.9, 0);
  const auto of_weak = region_of(weak, model), of_strong = region_of(strong, model);
  ASSERT_TRUE(of_weak && of_strong);
  EXPECT_GT(of_strong->log_volume, of_weak->log_volume + 1);
}

TEST(Region, HasNoMoreThanAQuarterTurnOfAnAngle) {
  const upright::Model model;
  const Task task = upright::task(50, 0);
  const auto region = region_of(task, model);
  ASSERT_TRUE(region);
  const Matrix inverse = region->hand_over.shape.inverse();
  EXPECT_NEAR(std::sqrt(inverse(0, 0)), std::numbers::pi / 2, 1e-6);
  EXPECT_NEAR(region->log_volume, 0.5 * std::log(inverse.determinant()), 1e-9);
}

TEST(Region, IsOfTheStatesThatAPolicySees) {
  Task task = line::task();
  task.states[0].kind = StateKind::omitted;
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& next, VectorView rewards) {
    rewards = -next.col(1).cwiseAbs2();
  };
  const line::Model model;
  const auto region = region_of(task, model);
  ASSERT_TRUE(region);
  EXPECT_TRUE(region->hand_over.shape.row(0).isZero(0) && region->hand_over.shape.col(0).isZero(0));
  EXPECT_GT(region->hand_over.shape(1, 1), 0);
}

TEST(Region, IsNotThereWhereNoFeedbackHoldsTheRobot) {
  /// Nothing moves it back.
  class Runaway final : public dynamics::DynamicsModel {
   public:
    void predict(const ConstMatrixView& X, const ConstMatrixView&, MatrixView mean,
                 MatrixView variance) const override {
      mean = 0.1 * X;
      variance.setZero();
    }
    bool certain() const override { return true; }
  };
  EXPECT_FALSE(region_of(line::task(), Runaway()));
}

// The cart's place matters: the region is smaller, and the feedback faster, than where the speed alone earns.
TEST(Region, IsWhereTheRewardComesBackToo) {
  Task slow = line::task(1), fast = line::task(1);
  slow.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& next, VectorView rewards) {
    rewards = (-next.col(1).array().square()).exp();
  };
  fast.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& next, VectorView rewards) {
    rewards = (-100 * next.col(0).array().square()).exp();
  };
  const line::Model model;
  const auto of_slow = region_of(slow, model), of_fast = region_of(fast, model);
  ASSERT_TRUE(of_slow && of_fast);
  EXPECT_LT(of_fast->log_volume, of_slow->log_volume);
  EXPECT_LT(of_fast->hand_over.feedback.gain(0, 0), of_slow->hand_over.feedback.gain(0, 0));
}

TEST(Region, IsTheSameForAnyNumberOfThreads) {
  const Task task = upright::task(0.3, 0);
  const upright::Model model;
  const auto one = region_of(task, model), three = region_of(task, model, *make_thread_evaluator(3));
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->hand_over.shape, three->hand_over.shape);
}

}  // namespace
}  // namespace rehearse::lqr
