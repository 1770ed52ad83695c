#pragma once
// A pendulum that a motor holds upright.

#include "line.hpp"

namespace rehearse::lqr::upright {

/// A pendulum, 0 is upright: the speed changes by sin(angle) + torque, the angle by the speed.
class Model final : public dynamics::DynamicsModel {
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
inline Task task(double bound, double goal) {
  Task task = line::task(bound);
  task.horizon = 100;
  task.states[0].kind = StateKind::angle;
  task.reward = [goal](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& next,
                       VectorView rewards) {
    rewards = (-2 * (next.col(0).array() - goal).square() - 0.1 * next.col(1).array().square()).exp();
  };
  return task;
}

}  // namespace rehearse::lqr::upright
