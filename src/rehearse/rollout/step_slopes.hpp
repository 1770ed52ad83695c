#pragma once

#include "rehearse/core/task.hpp"

namespace rehearse::rollout {

/// Derivatives of what steps earn, reward less cost, by central differences: `by` (rows × 2 dx + du, with a cost + du)
/// receives those by state, action, state reached and, with a cost, the action before. A row where the reward is not
/// finite is not finite. Most rewards are of the state reached alone: where a little more of everything else changes no
/// bit, its derivatives are 0 without a call for each. Without a cost `steps.U_before` is not read. No allocation if
/// the thread's last call had the same size.
void step_slopes(const Task& task, const Steps& steps, Matrix& by);

}  // namespace rehearse::rollout
