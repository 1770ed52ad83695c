#include "rehearse/core/task.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse {

FeatureMap Task::feature_map() const {
  std::vector<StateKind> kinds;
  for (const StateVariable& state : states) kinds.push_back(state.kind);
  return FeatureMap(std::move(kinds));
}

std::vector<std::string> Task::state_names() const {
  std::vector<std::string> names;
  for (const StateVariable& state : states) names.push_back(state.name);
  return names;
}

std::vector<std::string> Task::violations() const {
  Violations found;
  found.require(!states.empty(), "task has no states");
  found.require(!actions.empty(), "task has no actions");
  for (const ActionVariable& action : actions)
    found.require(
        std::isfinite(action.bounds.low) && std::isfinite(action.bounds.high) && action.bounds.low < action.bounds.high,
        fmt::format("action {}: bounds must be finite with low < high", action.name));
  found.require(start_mean.size() == state_size() && start_mean.allFinite(),
                fmt::format("start_mean has {} entries, must have {} finite ones", start_mean.size(), state_size()));
  found.require(start_std.size() == state_size() && start_std.allFinite() && (start_std.array() >= 0).all(),
                fmt::format("start_std has {} entries, must have {} of them, ≥ 0", start_std.size(), state_size()));
  found.require(dt_s > 0 && std::isfinite(dt_s), fmt::format("dt_s = {}, must be > 0", dt_s));
  found.require(horizon >= 1, fmt::format("horizon = {}, must be ≥ 1", horizon));
  found.require(static_cast<bool>(reward), "task has no reward");
  if (saturating_reward) {
    const Index features = feature_map().features();
    const auto& [goal, distances] = *saturating_reward;
    found.require(goal.size() == features && distances.cols() == features && goal.allFinite() && distances.allFinite(),
                  fmt::format("saturating_reward is of {} and {} features, must be of {} and finite", goal.size(),
                              distances.cols(), features));
  }
  found.require(std::isfinite(reward_floor), fmt::format("reward_floor = {}, must be finite", reward_floor));
  return found.list();
}

}  // namespace rehearse
