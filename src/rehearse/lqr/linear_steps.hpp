#pragma once

#include <vector>

#include "rehearse/lqr/backward_pass.hpp"
#include "rehearse/lqr/problem.hpp"

namespace rehearse::lqr {

/// Steps one after the other.
struct Trajectory {
  Matrix states, actions;  // steps + 1 × dx, steps × du
  Index steps = 0;
  double begin_s = 0;  // when the first step begins

  /// The steps as rows (steps × columns), and when each begins.
  Matrix rows(const Columns& columns) const;
  Vector times(const Task& task) const;
};

/// The steps of a trajectory as the planner sees them. at: written, the model's predictions there.
std::vector<PlannedStep> planned_steps(const Problem& problem, const StepCosts& costs, const Trajectory& trajectory,
                                       dynamics::Linearised& at);

}  // namespace rehearse::lqr
