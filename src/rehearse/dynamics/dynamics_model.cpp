#include "rehearse/dynamics/dynamics_model.hpp"

#include <algorithm>
#include <cmath>

namespace rehearse::dynamics {
namespace {

/// The step of a central difference by v. Rounding is 1e-12 of a prediction then, and what a simulator with errors of
/// 1e-10 adds is 1e-6.
double difference_step(double v) { return 1e-4 * std::max(1.0, std::abs(v)); }

/// The rows, then copies of them with one number less and more, in the order of states and actions.
struct Neighbours {
  Matrix X, U, mean, variance;

  void surround(const ConstMatrixView& states, const ConstMatrixView& actions) {
    const Index n = states.rows(), dx = states.cols(), du = actions.cols(), blocks = 1 + 2 * (dx + du);
    X.resize(n * blocks, dx);
    U.resize(n * blocks, du);
    mean.resize(n * blocks, dx);
    variance.resize(n * blocks, dx);
    for (Index b = 0; b < blocks; ++b) {
      X.middleRows(b * n, n) = states;
      U.middleRows(b * n, n) = actions;
      if (b == 0) continue;
      const Index input = (b - 1) / 2;
      const double sign = b % 2 == 1 ? -1 : 1;
      auto column = input < dx ? X.col(input).segment(b * n, n) : U.col(input - dx).segment(b * n, n);
      column = column.unaryExpr([&](double v) { return v + sign * difference_step(v); });
    }
  }
};

}  // namespace

void Linearised::resize(Index rows, Index states, Index actions) {
  mean.resize(rows, states);
  variance.resize(rows, states);
  mean_by.resize(rows, states * (states + actions));
  variance_by.resize(rows, states * (states + actions));
}

void DynamicsModel::linearise(const ConstMatrixView& X, const ConstMatrixView& U, Linearised& at) const {
  thread_local Neighbours near;
  const Index n = X.rows(), dx = X.cols(), inputs = dx + U.cols();
  near.surround(X, U);
  predict(near.X, near.U, near.mean, near.variance);
  at.resize(n, dx, U.cols());
  at.mean = near.mean.topRows(n);
  at.variance = near.variance.topRows(n);
  for (Index j = 0; j < inputs; ++j) {
    const Index less = (1 + 2 * j) * n, more = less + n;
    const auto v = j < dx ? X.col(j) : U.col(j - dx);
    for (Index k = 0; k < n; ++k) {
      const double width = 2 * difference_step(v(k));
      for (Index i = 0; i < dx; ++i) {
        at.mean_by(k, i * inputs + j) = (near.mean(more + k, i) - near.mean(less + k, i)) / width;
        at.variance_by(k, i * inputs + j) = (near.variance(more + k, i) - near.variance(less + k, i)) / width;
      }
    }
  }
}

void DynamicsModel::sample(const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& normals,
                           MatrixView change) const {
  thread_local Matrix variance;
  variance.resize(X.rows(), X.cols());
  predict(X, U, change, variance);
  change.array() += normals.array() * variance.array().sqrt();
}

}  // namespace rehearse::dynamics
