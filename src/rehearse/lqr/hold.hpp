#pragma once

#include <optional>

#include "rehearse/lqr/backward_pass.hpp"
#include "rehearse/lqr/problem.hpp"
#include "rehearse/lqr/step_costs.hpp"
#include "rehearse/policy/tracking.hpp"

namespace rehearse::lqr {

/// Linear feedback about a state in which the robot stays, for ever, and what it costs to come there from beside it.
struct Hold {
  policy::FeedbackStage stage;
  Value value;  // by the planner's state less that of the stage; 0 by the action before, which is taken to be the
                // stage's
};

/// The cheapest state in which the robot stays, near `state` and `action`, and the feedback of an infinite horizon
/// there (discrete Riccati equation), with the costs of a step that begins at time_s. nullopt if there is none within
/// the bounds of the actions, or none that feedback can hold by what a policy sees of the state. Any thread.
std::optional<Hold> find_hold(const Problem& problem, const StepCosts& costs, const Vector& state, const Vector& action,
                              double time_s);

/// The cheapest of those that are found from each row of states and actions. nullopt if there is none. Any thread.
std::optional<Hold> find_cheapest_hold(const Problem& problem, const StepCosts& costs, const Matrix& states,
                                       const Matrix& actions, double time_s);

}  // namespace rehearse::lqr
