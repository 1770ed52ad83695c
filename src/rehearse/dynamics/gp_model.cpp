#include "rehearse/dynamics/gp_model.hpp"

#include "rehearse/dynamics/integration.hpp"

namespace rehearse::dynamics {

void gp_inputs(const FeatureMap& features, const ConstMatrixView& X, const ConstMatrixView& U, MatrixView F) {
  features.apply(X, F.leftCols(features.features()));
  features.apply_actions(X, U, F.rightCols(U.cols()));
}

Matrix gp_inputs(const FeatureMap& features, const ConstMatrixView& X, const ConstMatrixView& U) {
  Matrix F(X.rows(), features.features() + U.cols());
  gp_inputs(features, X, U, F);
  return F;
}

/// What the prior predicts, and where the GPs are asked; memory of the calling thread.
struct GpModel::Point {
  Matrix prior_mean, middle, inputs;
};

const GpModel::Point& GpModel::look_at(const ConstMatrixView& X, const ConstMatrixView& U) const {
  thread_local Point point;
  point.inputs.resize(X.rows(), features_.features() + U.cols());
  if (mean_) {
    point.prior_mean.resize(X.rows(), X.cols());
    mean_->prior.mean(X, U, mean_->phi, point.prior_mean);
  }
  if (mean_ && mean_->midpoint) {
    point.middle = X + 0.5 * point.prior_mean;
    gp_inputs(features_, point.middle, U, point.inputs);
  } else {
    gp_inputs(features_, X, U, point.inputs);
  }
  return point;
}

void GpModel::finish(const Point& point, const ConstMatrixView& X, MatrixView mean) const {
  add_integrals(kinematics_, X, mean_.has_value(), mean);
  if (mean_) mean += point.prior_mean;
}

void GpModel::predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean, MatrixView variance) const {
  const Point& point = look_at(X, U);
  posterior_.predict(point.inputs, mean, variance);
  if (variance_ == PredictedVariance::noisy) variance.rowwise() += posterior_.noise_variances().transpose();
  add_variances_of_integrals(kinematics_, variance);
  finish(point, X, mean);
}

void GpModel::predict_mean(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean) const {
  const Point& point = look_at(X, U);
  posterior_.predict_mean(point.inputs, mean);
  finish(point, X, mean);
}

}  // namespace rehearse::dynamics
