#pragma once
// A mass on a line that is pulled to 0: linear steps and a quadratic reward, so that plans have a closed form.

#include "rehearse/lqr/problem.hpp"

namespace rehearse::lqr::line {

inline constexpr double kDt = 0.1, kActionCost = 0.05;

inline Task task(double bound = 100) {
  Task task;
  task.states = {{"place", "m", StateKind::plain, "speed"}, {"speed", "m/s"}};
  task.actions = {{"pull", "N", {-bound, bound}}};
  task.start_mean = Vector{{1, 0}};
  task.start_std = Vector::Zero(2);
  task.dt_s = kDt;
  task.horizon = 30;
  task.reward_floor = -10;
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& X_next, VectorView rewards) {
    rewards = -X_next.col(0).cwiseAbs2() - 0.1 * X_next.col(1).cwiseAbs2();
  };
  return task;
}

/// The place changes by the speed, the speed by the pull; both are uncertain by `variance` · (1 + place²).
class Model final : public dynamics::DynamicsModel {
 public:
  explicit Model(double variance = 0) : variance_(variance) {}
  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
               MatrixView variance) const override {
    mean.col(0) = kDt * X.col(1);
    mean.col(1) = kDt * U.col(0);
    for (Index i = 0; i < 2; ++i) variance.col(i) = variance_ * (1 + X.col(0).array().square());
  }
  bool certain() const override { return variance_ == 0; }

 private:
  double variance_;
};

}  // namespace rehearse::lqr::line
