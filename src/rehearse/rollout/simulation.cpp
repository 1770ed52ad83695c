#include "rehearse/rollout/simulation.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::rollout {

Index rows_at_once(const dynamics::DynamicsModel& model, const Task& task) {
  return std::max(model.rows_at_once(), task.rows_at_once);
}

Index rows_of_chunk(Index batch, Index usual, Index rows_at_once) {
  return std::min(std::max<Index>(1, batch),
                  std::max(usual, std::min(rows_at_once, std::max((batch + 1) / 2, rows_at_once / 4))));
}

Index groups_of_chunk(Index groups, Index rows, Index usual, Index rows_at_once) {
  return std::max<Index>(1, rows_of_chunk(groups * rows, usual * rows, rows_at_once) / rows);
}

std::vector<std::string> misfits(const policy::Policy& policy, Index parameters, const Task& task) {
  std::vector<std::string> lines;
  if (parameters != policy.parameters())
    lines.push_back(fmt::format("theta has {} numbers, must have the {} of the policy '{}'", parameters,
                                policy.parameters(), policy.name()));
  if (policy.actions() != task.action_size())
    lines.push_back(fmt::format("the policy '{}' has {} actions, must have the {} of the task", policy.name(),
                                policy.actions(), task.action_size()));
  return lines;
}

void check_simulation(const Simulation& simulation, Index parameters, Index particles) {
  Violations found;
  found.add(misfits(simulation.policy, parameters, simulation.task));
  if (particles < 1) found.add(fmt::format("particles = {}, must be ≥ 1", particles));
  found.throw_if_any();
}

}  // namespace rehearse::rollout
