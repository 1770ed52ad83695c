#pragma once
// Expected returns with their gradients by a policy's parameters: simulated episodes as functions of θ under given
// random numbers, and the chain rule backwards through reward, model and policy (Amadio 2022, section III-C).

#include "rehearse/core/evaluator.hpp"
#include "rehearse/rollout/simulation.hpp"

namespace rehearse::rollout {

struct ReturnGradients {
  Vector returns;    // mean over particles, one a candidate
  Matrix by_theta;   // parameters × candidates, of these
  Index failed = 0;  // rollouts that ended because a prediction was not finite
};

/// The rollouts that `simulate` makes of the same candidates, and their gradients. Where an episode ends, by a fall, a
/// broken limit or a failure, the gradient takes the end's step as given: what comes after is charged, and counts
/// nothing. Draws are taken to be the model's mean and so many deviations of each state by itself, which those of
/// servos are not. Rewards of whole episodes are left out. The same bytes for any number of threads. Throws
/// InvalidInput where sizes are wrong, and if the policy is not policy::Differentiable.
ReturnGradients return_gradients(const Simulation& simulation, const ConstMatrixView& Theta,
                                 const Candidates& candidates, const Evaluator& evaluator);

}  // namespace rehearse::rollout
