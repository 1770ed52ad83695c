#include "rehearse/dynamics/gp_model.hpp"

#include "rehearse/core/feature_slopes.hpp"
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

/// The prior's predictions, and the inputs of the GPs; memory of the calling thread.
struct GpModel::Point {
  Matrix prior_mean, middle, inputs;
};

const GpModel::Point& GpModel::look_at(const ConstMatrixView& X, const ConstMatrixView& U) const {
  thread_local Point point;
  point.inputs.resize(X.rows(), features_.features() + U.cols());
  if (prior_) {
    point.prior_mean.resize(X.rows(), X.cols());
    prior_->predict_mean(X, U, point.prior_mean);
  }
  if (midpoint_) {
    point.middle = X;
    if (prior_)
      point.middle += 0.5 * point.prior_mean;
    else
      add_half_step(kinematics_, X, point.middle);
    gp_inputs(features_, point.middle, U, point.inputs);
  } else {
    gp_inputs(features_, X, U, point.inputs);
  }
  return point;
}

void GpModel::finish(const Point& point, const ConstMatrixView& X, MatrixView mean) const {
  add_integrals(kinematics_, X, prior_.has_value(), mean);
  if (prior_) mean += point.prior_mean;
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

/// Derivatives of one number a row: by inputs of the GPs (n × features + du) → by states, then actions (n × dx + du).
void GpModel::to_states(const Point& point, const ConstMatrixView& by_inputs, const Matrix& prior_by,
                        MatrixView by) const {
  thread_local Matrix by_place;  // by the states at which the GPs are evaluated
  const Index features = features_.features(), du = by_inputs.cols() - features, dx = by.cols() - du;
  auto by_states = by.leftCols(dx);
  auto by_actions = by.rightCols(du);
  pull_back_features(features_, point.inputs.leftCols(features), by_inputs.leftCols(features), by_states);
  pull_back_targets(features_, by_inputs.rightCols(du), by_states);
  by_actions = by_inputs.rightCols(du);
  if (!midpoint_) return;
  by_place = by_states;
  if (!prior_) return add_half_step_of_derivatives(kinematics_, by_place, by);
  for (Index k = 0; k < dx; ++k)  // it is X + ½ prior mean
    for (Index j = 0; j < by.cols(); ++j)
      by.col(j).array() += 0.5 * by_place.col(k).array() * prior_by.col(k * by.cols() + j).array();
}

void GpModel::linearise(const ConstMatrixView& X, const ConstMatrixView& U, Linearised& at) const {
  thread_local Linearised of_prior;
  thread_local Matrix mean_by, variance_by;
  const Index n = X.rows(), dx = X.cols(), inputs = dx + U.cols();
  const Point& point = look_at(X, U);
  const Index D = point.inputs.cols();
  at.resize(n, dx, U.cols());
  mean_by.resize(n, dx * D), variance_by.resize(n, dx * D);
  posterior_.linearise(point.inputs, at.mean, at.variance, mean_by, variance_by);
  if (variance_ == PredictedVariance::noisy) at.variance.rowwise() += posterior_.noise_variances().transpose();
  add_variances_of_integrals(kinematics_, at.variance);
  finish(point, X, at.mean);
  if (prior_) prior_->linearise(X, U, of_prior);
  for (Index i = 0; i < dx; ++i) {
    to_states(point, mean_by.middleCols(i * D, D), of_prior.mean_by, at.mean_by.middleCols(i * inputs, inputs));
    to_states(point, variance_by.middleCols(i * D, D), of_prior.mean_by, at.variance_by.middleCols(i * inputs, inputs));
  }
  add_integrals_of_derivatives(kinematics_, prior_.has_value(), at);
  if (prior_) at.mean_by += of_prior.mean_by;
}

}  // namespace rehearse::dynamics
