#include "rehearse/rollout/simulation.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::rollout {

void check_simulation(const Simulation& simulation, Index parameters, Index particles) {
  const policy::Policy& policy = simulation.policy;
  const Task& task = simulation.task;
  if (parameters == policy.parameters() && policy.actions() == task.action_size() && particles >= 1) return;
  Violations found;
  found.require(parameters == policy.parameters(),
                fmt::format("theta has {} numbers, must have the {} of the policy '{}'", parameters,
                            policy.parameters(), policy.name()));
  found.require(policy.actions() == task.action_size(),
                fmt::format("the policy '{}' has {} actions, must have the {} of the task", policy.name(),
                            policy.actions(), task.action_size()));
  found.require(particles >= 1, fmt::format("particles = {}, must be ≥ 1", particles));
  found.throw_if_any();
}

}  // namespace rehearse::rollout
