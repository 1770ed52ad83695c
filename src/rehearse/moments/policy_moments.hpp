#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "rehearse/moments/moment_matching.hpp"
#include "rehearse/moments/squash_moments.hpp"

namespace rehearse::moments {

/// The part of the forward pass that the adjoint needs; reused without allocation of what grows with the centres.
struct PolicyTape {
  MomentTape network;  // of an RBF policy
  Transformed before;  // the squash
  Transformed squash;
};

/// The adjoint of a policy's numbers, summed over the steps of a rollout.
struct PolicyAdjoint {
  std::vector<TermAdjoint> networks;  // of an RBF policy, one an action
  Matrix slopes;                      // of a linear policy, actions × features
  Vector offsets;                     // of a linear policy, one an action
};

/// The moments of a policy at one θ, where its features are Gaussian. Immutable; any thread.
class PolicyMoments {
 public:
  virtual ~PolicyMoments() = default;

  /// False: θ is not finite, or so extreme that there are no moments; nothing else may be called then.
  virtual bool ok() const = 0;

  Index features() const { return features_; }
  Index actions() const { return actions_; }

  /// False if there are no moments, as in moments/moment_matching.hpp. Throws InvalidInput if the features are not as
  /// many as the policy's.
  bool forward(const Gaussian& features, PolicyTape& tape, Transformed& action, const Evaluator& evaluator) const;

  /// Adds to the adjoints of the features and of the policy what the adjoint of the action brings.
  void adjoint(const Gaussian& features, const PolicyTape& tape, const Transformed& adjoint, Gaussian& features_adjoint,
               PolicyAdjoint& policy) const;
  virtual PolicyAdjoint zero_adjoints() const = 0;

  /// The gradient by θ, once for the sum of the adjoints of all steps.
  virtual Vector gradient(const PolicyAdjoint& adjoint) const = 0;

 protected:
  PolicyMoments(Index features, const std::vector<Interval>& bounds)
      : features_(features), actions_(static_cast<Index>(bounds.size())), squash_(bounds) {}

 private:
  /// `forward` and `adjoint` of the actions before the squash, which is shared. tape.before is written, and read.
  virtual bool forward_before(const Gaussian& features, PolicyTape& tape, const Evaluator& evaluator) const = 0;
  virtual void adjoint_before(const Gaussian& features, const PolicyTape& tape, const Transformed& adjoint,
                              Gaussian& features_adjoint, PolicyAdjoint& policy) const = 0;

  Index features_, actions_;
  SquashMoments squash_;
};

}  // namespace rehearse::moments
