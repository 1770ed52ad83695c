#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "rehearse/core/random.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::policy {

/// Open loop: the action of step t is the t-th of θ, moved into its bounds. θ: the first action of every step, then the
/// second, … After the last step the last actions are held. Throws InvalidInput if dt_s or steps is not positive, or
/// there are no bounds.
std::shared_ptr<const Policy> make_schedule(std::vector<Interval> bounds, double dt_s, Index steps);

/// The schedule of a task's actions, for its whole horizon.
inline std::shared_ptr<const Policy> make_schedule(const Task& task) {
  return make_schedule(task.action_bounds(), task.dt_s, task.horizon);
}

/// The name of the schedule.
inline constexpr const char* kSchedule = "schedule";

enum class RandomActions {
  uniform,   // in their bounds
  extremes,  // one bound or the other: a random binary signal, which moves a system most
};

/// θ of such a policy for the task's whole horizon: random actions, each held for `hold_s` (rounded to whole steps, at
/// least one, and at most to a fifth of the episode). Random numbers come from the whole key.
Vector random_schedule(const Task& task, RandomActions actions, double hold_s, StreamKey key);

}  // namespace rehearse::policy
