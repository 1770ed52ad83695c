#pragma once

#include <optional>

#include "rehearse/learners/gp_ilqg/plan_problem.hpp"
#include "rehearse/learners/gp_ilqg/step_costs.hpp"

namespace rehearse::learners::gp_ilqg {

/// The cheapest state in which the robot stays, near `state` and `action`, and the feedback of an infinite horizon
/// there (discrete Riccati equation). nullopt if there is none within the bounds of the actions, or none that feedback
/// can hold. Any thread.
std::optional<Hold> find_hold(const PlanProblem& problem, const StepCosts& costs, const Vector& state,
                              const Vector& action);

}  // namespace rehearse::learners::gp_ilqg
