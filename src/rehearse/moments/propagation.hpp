#pragma once

#include "rehearse/moments/feature_moments.hpp"
#include "rehearse/moments/moment_matching.hpp"
#include "rehearse/moments/policy_moments.hpp"

namespace rehearse::moments {

/// The part of the forward pass that the adjoint of a step needs.
struct StepTape {
  PolicyTape policy;
  Transformed action;
  Gaussian inputs;  // of the dynamics: features of the state, then actions
  Matrix gain;      // of the inputs, dx × (features + du)
  MomentTape dynamics;
  Transformed change;
};

/// The adjoints of what a step begins with.
struct StepAdjoint {
  Gaussian& state;
  Transformed& features;
  PolicyAdjoint& policy;
};

/// One control step of a Gaussian state under a policy: features → action → inputs of the dynamics → change of the
/// state → next state (Deisenroth 2011, section 2.2; PILCO's propagate). `dynamics` is of (features, actions), its
/// outputs are the changes of all states; the policy sees the first of the features, as many as it has. References must
/// outlive it. Any thread.
class Propagation {
 public:
  /// Throws InvalidInput if the dynamics have fewer inputs than the policy has features and actions.
  Propagation(const MomentMatching& dynamics, const PolicyMoments& policy, const Evaluator& evaluator);

  /// features: of the state. False, and `next` undefined, where there are no moments. Throws InvalidInput if states or
  /// features are not as many as those of the dynamics.
  bool forward(const Gaussian& state, const Transformed& features, StepTape& tape, Gaussian& next) const;

  /// Adds to the adjoints of what a step began with what the adjoint of the next state brings.
  void adjoint(const Gaussian& state, const Transformed& features, const StepTape& tape, const Gaussian& next_adjoint,
               StepAdjoint adjoint) const;

 private:
  const MomentMatching& dynamics_;
  const PolicyMoments& policy_;
  const Evaluator& evaluator_;
};

}  // namespace rehearse::moments
