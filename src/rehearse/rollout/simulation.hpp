#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::rollout {

struct SimulateOptions {
  double noise_clip = 1;         // samples are clipped to ± so many standard deviations; 0: not clipped
  bool sample = true;            // false: the mean prediction alone is followed
  double measurement_noise = 1;  // times the model's estimate of measurement noise, which is added to the states that
                                 // the policy sees, with samples or without; 0: it sees the true state (the paper)
  double deviations = 1;         // samples are so many times as far from the mean as the model says; no field
  void fields(FieldVisitor& v) {
    v.number("noise_clip", noise_clip,
             "sampled model noise is clipped to this many standard deviations; 0: not clipped", at_least(0),
             published(1, kAuthors));
    v.boolean("sample", sample, "rollouts sample the model's uncertainty; false: they follow its mean");
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

/// The rollouts of a batch within a stream: candidates numbered from `first` on, each with so many particles.
struct Candidates {
  std::uint64_t first = 0;
  Index particles = 1;
};

/// The candidates of episodes, one a row: numbered from `first` on, and from there again after `period` rows; 0: never.
struct Numbering {
  std::uint64_t first = 0;
  Index period = 0;
};

/// The rows that a step should have to be worth the calls of a model and of a task's functions.
Index rows_at_once(const dynamics::DynamicsModel& model, const Task& task);

/// The rows of a chunk that goes in lockstep, by the size of the batch alone: `usual`, or more where a model is dear to
/// call (system::Simulator::rows_at_once): it is called twice a step, for two threads, unless a quarter of the rows
/// that make up for a call are all there are.
Index rows_of_chunk(Index batch, Index usual, Index rows_at_once);

/// The same for groups of `rows` rows that stay together: the groups of a chunk, at least one.
Index groups_of_chunk(Index groups, Index rows, Index usual, Index rows_at_once);

/// A line for each way in which θ of so many numbers, a policy and a task do not fit together.
std::vector<std::string> misfits(const policy::Policy& policy, Index parameters, const Task& task);

/// Throws InvalidInput unless θ of so many numbers, the policy and the task fit together. particles: ≥ 1.
void check_simulation(const Simulation& simulation, Index parameters, Index particles);

}  // namespace rehearse::rollout
