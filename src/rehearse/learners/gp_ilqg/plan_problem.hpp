#pragma once

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/learners/gp_ilqg/backward_pass.hpp"
#include "rehearse/policy/tracking.hpp"

namespace rehearse::learners::gp_ilqg {

/// The end of a plan: linear feedback for ever, and what it costs to come from beside it.
struct Hold {
  policy::FeedbackStage stage;
  Value value;  // by the planner's state less that of the stage
};

/// The model and the task that are planned on. References must outlive it.
struct PlanProblem {
  const dynamics::DynamicsModel& model;
  const Task& task;  // its start's spread is not used
  const Evaluator& evaluator;
};

}  // namespace rehearse::learners::gp_ilqg
