#include "rehearse/dynamics/integration.hpp"

#include <vector>

namespace rehearse::dynamics {
namespace {

/// The pairs from the last to the first: a rate that is a position itself is whole before its own position follows.
/// Not std::views::reverse, which Clang 14 does not compile with GCC's library (scripts/fuzz).
struct Reversed {
  const std::vector<Kinematics::Pair>& pairs;
  auto begin() const { return pairs.rbegin(); }
  auto end() const { return pairs.rend(); }
};

Reversed from_the_last(const Kinematics& kinematics) { return {kinematics.pairs}; }

}  // namespace

void add_half_step(const Kinematics& kinematics, const ConstMatrixView& X, MatrixView states) {
  for (const auto& [position, rate] : kinematics.pairs) states.col(position) += 0.5 * kinematics.dt_s * X.col(rate);
}

void add_half_step_of_derivatives(const Kinematics& kinematics, const ConstMatrixView& by_halfway, MatrixView by) {
  for (const auto& [position, rate] : kinematics.pairs)
    by.col(rate) += 0.5 * kinematics.dt_s * by_halfway.col(position);
}

void subtract_integrals(const Kinematics& kinematics, const ConstMatrixView& X, bool has_prior, MatrixView Y) {
  const double dt = kinematics.dt_s;
  for (const auto& [position, rate] : kinematics.pairs) {
    Y.col(position) -= 0.5 * dt * Y.col(rate);
    if (!has_prior) Y.col(position) -= dt * X.col(rate);
  }
}

void add_integrals(const Kinematics& kinematics, const ConstMatrixView& X, bool has_prior, MatrixView mean) {
  const double dt = kinematics.dt_s;
  for (const auto& [position, rate] : from_the_last(kinematics)) {
    mean.col(position) += 0.5 * dt * mean.col(rate);
    if (!has_prior) mean.col(position) += dt * X.col(rate);
  }
}

void add_variances_of_integrals(const Kinematics& kinematics, MatrixView variance) {
  const double dt = kinematics.dt_s;
  for (const auto& [position, rate] : from_the_last(kinematics))
    variance.col(position) += 0.25 * dt * dt * variance.col(rate);
}

void add_integrals_of_derivatives(const Kinematics& kinematics, bool has_prior, Linearised& at) {
  const double dt = kinematics.dt_s;
  const Index inputs = at.mean_by.cols() / at.mean.cols();
  for (const auto& [position, rate] : from_the_last(kinematics)) {
    const auto add = [&, position = position, rate = rate](Matrix& by, double factor) {
      by.middleCols(position * inputs, inputs) += factor * by.middleCols(rate * inputs, inputs);
    };
    add(at.mean_by, 0.5 * dt);
    add(at.variance_by, 0.25 * dt * dt);
    if (!has_prior) at.mean_by.col(position * inputs + rate).array() += dt;
  }
}

}  // namespace rehearse::dynamics
