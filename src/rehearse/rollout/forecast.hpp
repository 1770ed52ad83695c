#pragma once

#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::rollout {

/// A policy at one θ. References must outlive it.
struct FixedPolicy {
  const policy::Policy& policy;
  const Vector& theta;
};

/// Continues a model's mean prediction from every state of an episode under the actions that were taken. horizons:
/// ascending, in 1..T. Element i of the result has T − horizons[i] + 1 rows: row t is the state (dx) predicted for step
/// t + horizons[i] from the one measured at step t; NaN from the first prediction of a state on that was not finite.
/// The evaluator is asked before each step whether to stop.
std::vector<Matrix> forecast(const dynamics::DynamicsModel& model, const Episode& episode,
                             const std::vector<Index>& horizons, const Evaluator& evaluator = serial_evaluator());

/// The states (rows of `states`, n × dx) to which a policy leads in the model's mean in so many steps, without noise;
/// NaN where a prediction was not finite. Rows are spread over the evaluator's threads.
Matrix follow(const dynamics::DynamicsModel& model, const Task& task, const FixedPolicy& policy, const Matrix& states,
              Index steps, const Evaluator& evaluator = serial_evaluator());

}  // namespace rehearse::rollout
