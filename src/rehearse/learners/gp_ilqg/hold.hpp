#pragma once

#include <optional>

#include "rehearse/learners/gp_ilqg/plan_problem.hpp"
#include "rehearse/learners/gp_ilqg/step_costs.hpp"

namespace rehearse::learners::gp_ilqg {

/// The cheapest state in which the robot stays, near `state` and `action`, and the feedback of an infinite horizon
/// there (discrete Riccati equation), with the costs of a step that begins at time_s. nullopt if there is none within
/// the bounds of the actions, or none that feedback can hold by what a policy sees of the state. Any thread.
std::optional<Hold> find_hold(const PlanProblem& problem, const StepCosts& costs, const Vector& state,
                              const Vector& action, double time_s);

}  // namespace rehearse::learners::gp_ilqg
