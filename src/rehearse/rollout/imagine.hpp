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

struct ImagineOptions {
  double noise_clip = 1;  // samples are clipped to ± so many standard deviations; 0: not clipped (the authors' code: 1)
  bool sample = true;     // false: the mean prediction alone is followed
  bool common_random_numbers = false;  // every candidate meets the same noise
  void fields(FieldVisitor& v) {
    v.number("noise_clip", noise_clip, at_least(0));
    v.boolean("sample", sample);
    v.boolean("common_random_numbers", common_random_numbers);
  }
};

/// Returns of imagined episodes, one column a candidate.
struct Imagined {
  Matrix returns;    // particles × candidates
  Index failed = 0;  // rollouts that ended because a prediction was not finite
};

/// Imagines `particles` episodes of each policy (Theta: parameters × candidates), all rollouts in lockstep within
/// chunks of a fixed size that the evaluator spreads over threads. Rollout (candidate j, particle p) draws from the
/// stream (key, first_candidate + j, p): its value does not depend on the batch it is evaluated in, nor on threads.
/// A rollout that falls or fails is charged the reward floor for every remaining step.
Imagined imagine(const dynamics::DynamicsModel& model, const policy::Policy& policy, const Task& task,
                 const ConstMatrixView& Theta, std::uint64_t first_candidate, Index particles, const StreamKey& key,
                 const ImagineOptions& options, const Evaluator& evaluator);

/// The same for one policy, with every state: element t holds the states (particles × dx) at step t, t = 0..T;
/// after an early end a row is NaN.
struct Recorded {
  std::vector<Matrix> states;
  Vector returns;  // particles
};
Recorded imagine_recorded(const dynamics::DynamicsModel& model, const policy::Policy& policy, const Task& task,
                          const Vector& theta, Index particles, const StreamKey& key, const ImagineOptions& options);

}  // namespace rehearse::rollout
