#pragma once

#include <cstdint>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::rollout {

struct SimulateOptions {
  double noise_clip = 1;         // samples are clipped to ± so many standard deviations; 0: not clipped
  bool sample = true;            // false: the mean prediction alone is followed
  double measurement_noise = 1;  // times what the model takes for noise of measurements, which the policy meets, with
                                 // samples or without; 0: it sees the true state (the paper)
  void fields(FieldVisitor& v) {
    v.number("noise_clip", noise_clip, "samples are clipped to so many standard deviations; 0: not clipped",
             at_least(0), published(1, kAuthors));
    v.boolean("sample", sample, "rollouts meet the model's uncertainty; false: they follow its mean");
    v.number("measurement_noise", measurement_noise,
             "noise of measurements in rollouts, in units of what the model learned; 0: none", at_least(0),
             published(0));
  }
};

/// The parts of a rollout. References must outlive it.
struct Simulation {
  const dynamics::DynamicsModel& model;
  const policy::Policy& policy;
  const Task& task;
  StreamKey key = {};  // the streams of its random numbers: candidate, particle and step are added
  SimulateOptions options = {};
};

/// Which rollouts of a stream a batch is: its candidates are numbered from the first on, each with so many particles.
struct Candidates {
  std::uint64_t first = 0;
  Index particles = 1;
};

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
/// falls, breaks a limit or fails is charged the reward floor for every remaining step. Throws InvalidInput where sizes
/// are wrong.
Simulated simulate(const Simulation& simulation, const ConstMatrixView& Theta, const Candidates& candidates,
                   const Evaluator& evaluator);

/// The same for one policy, with every state: element t holds the states (particles × dx) at step t, t = 0..T;
/// after an early end a row is NaN.
struct Recorded {
  std::vector<Matrix> states;
  Matrix rewards;  // particles × T: what a step adds to the return, an early end all that is charged for the rest
  Vector returns;  // particles
};
Recorded simulate_recorded(const Simulation& simulation, const Vector& theta, Index particles);

/// Simulated episodes, one a row of a batch.
struct Episodes {
  std::vector<Matrix> states;   // T+1 of rows × dx
  std::vector<Matrix> actions;  // T of rows × du
  Matrix rewards;               // rows × T
  Vector returns;               // rows, with what was charged for an early end
  std::vector<Index> steps;     // made before the end
  std::vector<char> ended;      // by a fall or a broken limit: its state is the last one
  std::vector<char> failed;     // by a prediction that was not finite: this one is left out
  double reward_floor = 0;      // the task's

  Index rows() const { return returns.size(); }
  /// Allocates only where the episode has another size.
  void copy(Index row, Episode& episode) const;
};

/// One episode of each policy (Theta: rows × parameters, one a row) on the calling thread, all rows in lockstep. Row i
/// is candidate `first_candidate` + i of the stream. No allocation if `episodes` had the same size before.
void simulate_episodes(const Simulation& simulation, const ConstMatrixView& Theta, std::uint64_t first_candidate,
                       Episodes& episodes);

}  // namespace rehearse::rollout
