#pragma once

#include "rehearse/moments/policy_moments.hpp"
#include "rehearse/policy/network.hpp"

namespace rehearse::moments {

/// The moments of a policy of policy::make_linear with a sine as squash (Deisenroth 2010, section 3.5; PILCO's conlin).
class LinearPolicy final : public PolicyMoments {
 public:
  /// theta: in the order that policy/network.hpp says. Throws InvalidInput if it has another size, or the squash is
  /// none whose moments are known.
  LinearPolicy(const policy::LinearOptions& options, const ConstVectorView& theta);

  bool ok() const override { return slopes_.allFinite() && offsets_.allFinite(); }
  PolicyAdjoint zero_adjoints() const override;
  Vector gradient(const PolicyAdjoint& adjoint) const override;

 private:
  bool forward_before(const Gaussian& features, PolicyTape& tape, const Evaluator& evaluator) const override;
  void adjoint_before(const Gaussian& features, const PolicyTape& tape, const Transformed& adjoint,
                      Gaussian& features_adjoint, PolicyAdjoint& policy) const override;

  Matrix slopes_;   // actions × features
  Vector offsets_;  // one an action
  Matrix units_;    // the derivatives of both by θ, actions × (features + 1)
};

}  // namespace rehearse::moments
