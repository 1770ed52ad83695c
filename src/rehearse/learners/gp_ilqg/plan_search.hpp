#pragma once

#include <optional>
#include <vector>

#include "rehearse/core/events.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/learners/gp_ilqg/options.hpp"
#include "rehearse/learners/gp_ilqg/plan.hpp"

namespace rehearse::learners::gp_ilqg {

/// The plan of a trial.
struct FoundPlan {
  Vector theta;  // of make_tracking
  double predicted_return = 0;
  Index rollouts = 0, failed = 0;
};

/// Plans from random actions and from `last`, the plan of the trial before if there is one; improves the best, with and
/// without a hold at their end; and returns the one that is best in simulated episodes, with the model's uncertainty.
/// The same for any evaluator. nullopt: no plan is finite.
std::optional<FoundPlan> search_plan(const lqr::Problem& problem, const PlanSearch& search,
                                     const std::optional<Vector>& last, StreamKey stream, const ProgressSink& progress);

/// The number of steps of a task's episode that are planned.
Index steps_to_plan(const Task& task, const PlanSearch& search);

}  // namespace rehearse::learners::gp_ilqg
