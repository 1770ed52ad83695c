#pragma once
// A cart on a line: states (velocity, position), a force on it. Small enough for loops written by hand.

#include <functional>
#include <memory>

#include "rehearse/core/random.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/policy/network.hpp"

namespace rehearse::rollout::cart {

/// exp(−position²).
inline void reward(const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& X_next, VectorView rewards) {
  for (Index i = 0; i < X_next.rows(); ++i) rewards(i) = std::exp(-X_next(i, 1) * X_next(i, 1));
}

inline Task task(double start_std = 0.1) {
  Task task;
  task.states = {{"v", "m/s"}, {"p", "m"}};
  task.actions = {{"force", "N", {-2, 2}}};
  task.start_mean = Vector{{0, 1}};
  task.start_std = Vector::Constant(2, start_std);
  task.dt_s = 0.1;
  task.horizon = 20;
  task.reward = reward;
  task.reward_floor = -0.5;
  return task;
}

inline std::shared_ptr<const policy::Policy> policy() {
  const FeatureMap features({StateKind::plain, StateKind::plain});
  return policy::make_mlp({.features = features, .scale = Vector::Ones(2), .hidden = 3, .squash = {{{-2, 2}}, 1}});
}

/// parameters × candidates, θ uniform in ±2.
inline Matrix candidates(Index count, std::uint64_t seed = 1) {
  Rng rng({.seed = seed});
  Matrix Theta(policy()->parameters(), count);
  for (double& value : Theta.reshaped()) value = rng.uniform(-2, 2);
  return Theta;
}

/// One explicit Euler step; `variance` the same everywhere; may be told to spoil rows, and what measurements add.
class Model final : public dynamics::DynamicsModel {
 public:
  using Spoil = std::function<bool(double velocity, double position)>;
  explicit Model(double variance = 0, Spoil spoil = {}, Vector measurement_std = {})
      : variance_(variance), spoil_(std::move(spoil)), measurement_std_(std::move(measurement_std)) {}
  const Vector& measurement_std() const override { return measurement_std_; }

  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
               MatrixView variance) const override {
    mean.col(0) = 0.1 * U.col(0);
    mean.col(1) = 0.1 * X.col(0);
    variance.setConstant(variance_);
    for (Index i = 0; spoil_ && i < X.rows(); ++i)
      if (spoil_(X(i, 0), X(i, 1))) mean.row(i).setConstant(kNaN);
  }

 private:
  double variance_;
  Spoil spoil_;
  Vector measurement_std_;
};

/// A rollout by hand: the noise of row t of `noise` (T × 2) times `std`, the policy meets `errors` (T × 2, or none);
/// the states, T + 1 × 2.
struct ByHand {
  Matrix states;
  double value = 0;
};
inline ByHand by_hand(const Task& task, const Vector& theta, const Vector& start, const Matrix& noise, double std,
                      const Matrix& errors = {}) {
  ByHand result{.states = Matrix(task.horizon + 1, 2)};
  result.states.row(0) = start.transpose();
  Matrix u(1, 1);
  for (Index t = 0; t < task.horizon; ++t) {
    const Matrix x = result.states.row(t);
    const Matrix seen = errors.size() > 0 ? Matrix(x + errors.row(t)) : x;
    policy()->act(theta.transpose(), seen, 0, u);
    result.states(t + 1, 0) = x(0, 0) + 0.1 * u(0, 0) + std * noise(t, 0);
    result.states(t + 1, 1) = x(0, 1) + 0.1 * x(0, 0) + std * noise(t, 1);
    result.value += std::exp(-result.states(t + 1, 1) * result.states(t + 1, 1));
  }
  return result;
}

}  // namespace rehearse::rollout::cart
