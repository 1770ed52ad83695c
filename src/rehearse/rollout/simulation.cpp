#include "rehearse/rollout/simulation.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::rollout {

void check_simulation(const Simulation& simulation, Index parameters, Index particles) {
  const policy::Policy& policy = simulation.policy;
  const Task& task = simulation.task;
  if (parameters == policy.parameters() && policy.actions() == task.action_size() && particles >= 1) return;
  throw InvalidInput(
      fmt::format("theta has {} numbers for the {} of the policy '{}', which has {} actions for the {} of the task; "
                  "particles = {}, must be ≥ 1",
                  parameters, policy.parameters(), policy.name(), policy.actions(), task.action_size(), particles));
}

}  // namespace rehearse::rollout
