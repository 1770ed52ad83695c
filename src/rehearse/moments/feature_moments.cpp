#include "rehearse/moments/feature_moments.hpp"

#include <numbers>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::moments {

FeatureMoments::FeatureMoments(const FeatureMap& features) : outputs_(features.features()) {
  const Index dx = features.states(), joints = static_cast<Index>(features.joints().size());
  Index output = 0;
  const auto add_angle = [&](Index input) {
    sines_.push_back({.output = output++, .input = input, .phase = std::numbers::pi / 2});
    sines_.push_back({.output = output++, .input = input});
  };
  for (Index input = 0; input < dx; ++input) {
    const StateKind kind = features.kinds()[static_cast<std::size_t>(input)];
    if (kind == StateKind::plain) plain_.push_back({output++, input});
    if (kind == StateKind::angle) add_angle(input);
  }
  angles_ = Matrix::Identity(dx + joints, dx);
  for (Index j = 0; j < joints; ++j) {
    const auto [angle, parent] = features.joints()[static_cast<std::size_t>(j)];
    angles_(dx + j, angle) = 1;
    angles_(dx + j, parent) = -1;
    add_angle(dx + j);
  }
}

Gaussian FeatureMoments::angles(const Gaussian& state) const {
  return {angles_ * state.mean, angles_ * state.covariance * angles_.transpose()};
}

Transformed FeatureMoments::operator()(const Gaussian& state) const {
  if (state.size() != states() || state.covariance.rows() != states() || state.covariance.cols() != states())
    throw InvalidInput(fmt::format("features: a state of {} variables, must be of {}", state.size(), states()));
  const bool joints = angles_.rows() > angles_.cols();
  Transformed result = sine_moments(sines_, outputs_, joints ? angles(state) : state);
  if (joints) result.gain = (angles_.transpose() * result.gain).eval();
  for (const Plain& p : plain_) {
    result.mean(p.output) = state.mean(p.input);
    result.gain(p.input, p.output) = 1;
  }
  for (const Plain& p : plain_) {
    const Vector cross = (state.covariance.row(p.input) * result.gain).transpose();
    result.covariance.row(p.output) = cross.transpose();
    result.covariance.col(p.output) = cross;
  }
  return result;
}

void FeatureMoments::adjoint(const Gaussian& state, const Transformed& result, const Transformed& adjoint,
                             Gaussian& state_adjoint) const {
  Transformed of_sines = adjoint;
  for (const Plain& p : plain_) {
    Vector cross = adjoint.covariance.row(p.output).transpose() + adjoint.covariance.col(p.output);
    for (const Plain& other : plain_) cross(other.output) = adjoint.covariance(p.output, other.output);
    state_adjoint.mean(p.input) += adjoint.mean(p.output);
    state_adjoint.covariance.row(p.input) += (result.gain * cross).transpose();
    of_sines.gain += state.covariance.col(p.input) * cross.transpose();
  }
  if (angles_.rows() == angles_.cols()) return sine_adjoint(sines_, state, of_sines, state_adjoint);
  of_sines.gain = (angles_ * of_sines.gain).eval();
  Gaussian of_angles = Gaussian::zero(angles_.rows());
  sine_adjoint(sines_, angles(state), of_sines, of_angles);
  state_adjoint.mean += angles_.transpose() * of_angles.mean;
  state_adjoint.covariance += angles_.transpose() * of_angles.covariance * angles_;
}

}  // namespace rehearse::moments
