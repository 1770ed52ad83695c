#include "rehearse/dynamics/gp_model.hpp"

#include "rehearse/dynamics/integration.hpp"

namespace rehearse::dynamics {

void gp_inputs(const FeatureMap& features, const ConstMatrixView& X, const ConstMatrixView& U, MatrixView F) {
  features.apply(X, F.leftCols(features.features()));
  F.rightCols(U.cols()) = U;
}

Matrix gp_inputs(const FeatureMap& features, const ConstMatrixView& X, const ConstMatrixView& U) {
  Matrix F(X.rows(), features.features() + U.cols());
  gp_inputs(features, X, U, F);
  return F;
}

void GpModel::predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean, MatrixView variance) const {
  thread_local Matrix inputs, prior_mean, middle;
  inputs.resize(X.rows(), features_.features() + U.cols());
  if (mean_) {
    prior_mean.resize(X.rows(), X.cols());
    mean_->prior.mean(X, U, mean_->phi, prior_mean);
  }
  if (mean_ && mean_->midpoint) {
    middle = X + 0.5 * prior_mean;
    gp_inputs(features_, middle, U, inputs);
  } else {
    gp_inputs(features_, X, U, inputs);
  }
  posterior_.predict(inputs, mean, variance);
  if (variance_ == PredictedVariance::noisy) variance.rowwise() += posterior_.noise_variances().transpose();
  add_integrals(kinematics_, X, mean_.has_value(), mean, variance);
  if (mean_) mean += prior_mean;
}

}  // namespace rehearse::dynamics
