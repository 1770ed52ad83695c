#include "rehearse/core/feature_moments.hpp"

#include <numbers>

#include "rehearse/core/errors.hpp"

namespace rehearse {

FeatureMoments::FeatureMoments(const FeatureMap& features) : outputs_(features.features()) {
  if (!features.joints().empty()) throw InvalidInput("no moments of features with joint angles");
  Index output = 0;
  for (Index input = 0; input < features.states(); ++input) {
    const StateKind kind = features.kinds()[static_cast<std::size_t>(input)];
    if (kind == StateKind::plain) plain_.push_back({output++, input});
    if (kind == StateKind::angle) {
      sines_.push_back({.output = output++, .input = input, .phase = std::numbers::pi / 2});
      sines_.push_back({.output = output++, .input = input});
    }
  }
}

Transformed FeatureMoments::operator()(const Gaussian& state) const {
  Transformed result = sine_moments(sines_, outputs_, state);
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
  sine_adjoint(sines_, state, of_sines, state_adjoint);
}

}  // namespace rehearse
