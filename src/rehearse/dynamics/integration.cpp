#include "rehearse/dynamics/integration.hpp"

namespace rehearse::dynamics {

void subtract_integrals(const Kinematics& kinematics, const ConstMatrixView& X, bool has_prior, MatrixView Y) {
  const double dt = kinematics.dt_s;
  for (const auto& [position, rate] : kinematics.pairs) {
    Y.col(position) -= 0.5 * dt * Y.col(rate);
    if (!has_prior) Y.col(position) -= dt * X.col(rate);
  }
}

void add_integrals(const Kinematics& kinematics, const ConstMatrixView& X, bool has_prior, MatrixView mean) {
  const double dt = kinematics.dt_s;
  for (const auto& [position, rate] : kinematics.pairs) {
    mean.col(position) += 0.5 * dt * mean.col(rate);
    if (!has_prior) mean.col(position) += dt * X.col(rate);
  }
}

void add_variances_of_integrals(const Kinematics& kinematics, MatrixView variance) {
  const double dt = kinematics.dt_s;
  for (const auto& [position, rate] : kinematics.pairs) variance.col(position) += 0.25 * dt * dt * variance.col(rate);
}

}  // namespace rehearse::dynamics
