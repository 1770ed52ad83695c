#include "rehearse/moments/linear_policy.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::moments {

LinearPolicy::LinearPolicy(const policy::LinearOptions& options, const ConstVectorView& theta)
    : PolicyMoments(options.scale.size(), options.squash.bounds) {
  const Index inputs = options.scale.size(), actions = static_cast<Index>(options.squash.bounds.size());
  Violations violations;
  violations.require(theta.size() == actions * (inputs + 1),
                     fmt::format("policy: θ has {} numbers, must have {}", theta.size(), actions * (inputs + 1)));
  violations.require(options.squash.shape == policy::Squash::Shape::sine,
                     "policy: the moments of its squash are not known, it must be sine");
  violations.throw_if_any();
  units_.setConstant(actions, inputs + 1, options.squash.gain);
  units_.leftCols(inputs) *= options.scale.cwiseInverse().asDiagonal();
  const Matrix weights = theta.reshaped(inputs + 1, actions).transpose().cwiseProduct(units_);
  slopes_ = weights.leftCols(inputs);
  offsets_ = weights.col(inputs);
}

bool LinearPolicy::forward_before(const Gaussian& features, PolicyTape& tape, const Evaluator&) const {
  tape.before = affine_moments(slopes_, offsets_, features);
  return true;
}

void LinearPolicy::adjoint_before(const Gaussian& features, const PolicyTape&, const Transformed& adjoint,
                                  Gaussian& features_adjoint, PolicyAdjoint& policy) const {
  affine_adjoint(slopes_, features, adjoint, features_adjoint, policy.slopes, policy.offsets);
}

PolicyAdjoint LinearPolicy::zero_adjoints() const {
  return {.slopes = Matrix::Zero(slopes_.rows(), slopes_.cols()), .offsets = Vector::Zero(offsets_.size())};
}

Vector LinearPolicy::gradient(const PolicyAdjoint& adjoint) const {
  Matrix by_weights(units_.rows(), units_.cols());
  by_weights << adjoint.slopes, adjoint.offsets;
  return by_weights.cwiseProduct(units_).transpose().reshaped();
}

}  // namespace rehearse::moments
