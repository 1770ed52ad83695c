#pragma once

#include "rehearse/moments/feature_moments.hpp"
#include "rehearse/moments/policy_moments.hpp"
#include "rehearse/moments/step_dynamics.hpp"

namespace rehearse::moments {

/// The part of the forward pass that the adjoint of a step needs.
struct StepTape {
  PolicyTape policy;
  Transformed action;
  Gaussian inputs;  // of the dynamics: features of the state, then actions
  Matrix gain;      // of the inputs, dx × (features + du)
  MomentTape dynamics;
  Transformed change;
  // Around a prior:
  Gaussian joint;  // states, actions
  PriorTape prior;
  Transformed prior_change;
  Matrix with_change;  // cov[(states, actions), change of the GPs]
};

/// The adjoints of what a step begins with.
struct StepAdjoint {
  Gaussian& state;
  Transformed& features;
  PolicyAdjoint& policy;
};

/// One control step of a Gaussian state under a policy: features → action → inputs of the dynamics → change of the
/// state → next state (Deisenroth 2011, section 2.2; PILCO's propagate). The policy sees the first of the features, as
/// many as it has. Around a prior covariances go through its gain A, too: with x̃ of states and actions, Δ the GPs',
/// Σ⁺ = A Σ̃ Aᵀ + S_Δ + A C + (A C)ᵀ, C = cov[x̃, Δ] (Saveriano 2017). References must outlive it. Any thread.
class Propagation {
 public:
  /// Throws InvalidInput if there are no dynamics, or they do not agree with each other or the policy.
  Propagation(StepDynamics dynamics, const PolicyMoments& policy, const Evaluator& evaluator);

  /// features: of the state. False, and `next` undefined, where there are no moments. Throws InvalidInput if states or
  /// features are not as many as those of the dynamics.
  bool forward(const Gaussian& state, const Transformed& features, StepTape& tape, Gaussian& next) const;

  /// Adds to the adjoints of what a step began with what the adjoint of the next state brings. Where there is a
  /// prior, `differentiate` comes before.
  void adjoint(const Gaussian& state, const Transformed& features, const StepTape& tape, const Gaussian& next_adjoint,
               StepAdjoint adjoint) const;

 private:
  /// The adjoints of a tape's `joint` and `with_change`.
  struct AroundPrior {
    Gaussian joint;
    Matrix with_change;
  };
  bool add_prior(const Gaussian& state, const Matrix& state_with_change, StepTape& tape, Gaussian& next) const;
  AroundPrior prior_adjoint(const StepTape& tape, const Gaussian& next_adjoint) const;

  StepDynamics dynamics_;
  const PolicyMoments& policy_;
  const Evaluator& evaluator_;
};

}  // namespace rehearse::moments
