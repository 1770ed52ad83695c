#include "rehearse/learners/gp_ilqg/hold.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "line.hpp"

namespace rehearse::learners::gp_ilqg {
namespace {

/// A pendulum, 0 is upright: the speed changes by sin(angle) + torque, the angle by the speed.
class Pendulum final : public dynamics::DynamicsModel {
 public:
  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
               MatrixView variance) const override {
    mean.col(0) = line::kDt * X.col(1);
    mean.col(1) = line::kDt * (X.col(0).array().sin() + U.col(0).array());
    variance.setZero();
  }
  bool certain() const override { return true; }
};

/// Reward for being within a width of `goal`.
Task pendulum(double bound, double goal) {
  Task task = line::task(bound);
  task.states[0].kind = StateKind::angle;
  task.reward = [goal](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& next,
                       VectorView rewards) {
    rewards = (-2 * (next.col(0).array() - goal).square() - 0.1 * next.col(1).array().square()).exp();
  };
  return task;
}

TEST(Hold, IsWhereTheRobotStaysAndEarnsMost) {
  const Task task = pendulum(2, 0);
  const Pendulum model;
  const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 1e-3});
  const auto hold = find_hold({model, task, serial_evaluator()}, costs, Vector{{0.2, 0.5}}, Vector{{0.4}});
  ASSERT_TRUE(hold);
  EXPECT_NEAR(hold->stage.state.norm(), 0, 1e-5);
  EXPECT_NEAR(hold->stage.action(0), 0, 1e-5);
  // x' = (A + B K) x, with A = (1, dt; dt, 1): both eigenvalues are within the unit circle.
  const auto k = hold->stage.gain;
  const double trace = 2 + line::kDt * k(0, 1),
               determinant = 1 + line::kDt * k(0, 1) - line::kDt * line::kDt * (1 + k(0, 0));
  EXPECT_LT(std::abs(trace), 1 + determinant);
  EXPECT_LT(determinant, 1);
}

TEST(Hold, MayNeedAnAction) {
  const Task task = pendulum(2, 0.5);
  const Pendulum model;
  const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 1e-6});
  const auto hold = find_hold({model, task, serial_evaluator()}, costs, Vector{{0.2, 0.5}}, Vector{{0}});
  ASSERT_TRUE(hold);
  EXPECT_NEAR(hold->stage.state(0), 0.5, 1e-3);
  EXPECT_NEAR(hold->stage.action(0), -std::sin(0.5), 1e-3);
}

TEST(Hold, IsNotThereWhereTheActionsAreTooWeak) {
  const Task task = pendulum(0.1, 1.2);
  const Pendulum model;
  const StepCosts costs(task, {.scale = CostScale::linear, .action_cost = 1e-6});
  EXPECT_FALSE(find_hold({model, task, serial_evaluator()}, costs, Vector{{1.2, 0}}, Vector{{0}}));
}

}  // namespace
}  // namespace rehearse::learners::gp_ilqg
