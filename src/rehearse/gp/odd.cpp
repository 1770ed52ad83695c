#include "rehearse/gp/odd.hpp"

#include "rehearse/gp/correlations.hpp"

namespace rehearse::gp {

Matrix unit_images(const Inputs& inputs, const Vector& signs) {
  const Eigen::RowVectorXd shift =
      (signs.array() - 1) * inputs.center().array() / inputs.half_range().array();  // of those that change
  return (inputs.unit() * signs.asDiagonal()).rowwise() + shift;
}

Matrix odd_covariance(const Inputs& inputs, const Vector& signs, const Hyperparameters& kernel) {
  const Matrix X = inputs.values();
  return (covariance(X, kernel) - covariance(X, X * signs.asDiagonal(), kernel)) / kernel.signal_variance();
}

Evidence odd_evidence(const Inputs& inputs, const Vector& signs, const ConstVectorView& y,
                      const Hyperparameters& kernel) {
  Workspace workspace;
  workspace.resize(inputs.size(), inputs.dimensions(), kernel.has_trend());
  return evidence(odd_covariance(inputs, signs, kernel), y, kernel, workspace);
}

}  // namespace rehearse::gp
