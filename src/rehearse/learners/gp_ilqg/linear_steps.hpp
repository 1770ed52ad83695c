#pragma once

#include <vector>

#include "rehearse/learners/gp_ilqg/forward_pass.hpp"

namespace rehearse::learners::gp_ilqg {

/// The steps of a trajectory as the planner sees them. at: written, the model's predictions there.
std::vector<PlannedStep> planned_steps(const PlanProblem& problem, const StepCosts& costs, const Trajectory& trajectory,
                                       dynamics::Linearised& at);

}  // namespace rehearse::learners::gp_ilqg
