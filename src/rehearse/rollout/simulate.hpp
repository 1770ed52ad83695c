#pragma once

#include <cstdint>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/rollout/episodes.hpp"
#include "rehearse/rollout/simulation.hpp"

namespace rehearse::rollout {

/// Returns of simulated episodes, one column a candidate.
struct Simulated {
  Matrix returns;              // particles × candidates
  std::vector<Matrix> broken;  // one a limit of the task, each particles × candidates: 0 where it was kept, else the
                               // fraction of the episode that was left when the step began that broke it
  Index failed = 0;            // rollouts that ended because a prediction was not finite
};

/// Simulates episodes of each policy (Theta: parameters × candidates), all rollouts in lockstep within chunks of a
/// fixed size that the evaluator spreads over threads. Rollout (candidate j, particle p) draws from the stream (key,
/// candidates.first + j, p): its value does not depend on the batch it is evaluated in, nor on threads. A rollout that
/// falls, breaks a limit or fails is charged the reward floor for every remaining step. Rewards of whole episodes are
/// of the steps that were made. Throws InvalidInput where sizes are wrong.
Simulated simulate(const Simulation& simulation, const ConstMatrixView& Theta, const Candidates& candidates,
                   const Evaluator& evaluator);

/// The same for one policy, with every state: element t holds the states (particles × dx) at step t, t = 0..T;
/// after an early end a row is NaN. On the calling thread; the evaluator is asked before each step whether to stop.
struct Recorded {
  std::vector<Matrix> states;
  Matrix rewards;  // particles × T: what a step adds to the return, an early end all that is charged for the rest
  Vector returns;  // particles, with the rewards of whole episodes
};
Recorded simulate_recorded(const Simulation& simulation, const Vector& theta, Index particles,
                           const Evaluator& evaluator = serial_evaluator());

/// One episode of each policy (Theta: rows × parameters, one a row) on the calling thread, all rows in lockstep, each a
/// candidate of the stream. No allocation if `episodes` had the same size before. The evaluator is asked before each
/// step whether to stop.
void simulate_episodes(const Simulation& simulation, const ConstMatrixView& Theta, const Numbering& candidates,
                       Episodes& episodes, const Evaluator& evaluator = serial_evaluator());

}  // namespace rehearse::rollout
