#pragma once

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/learners/gp_ilqg/backward_pass.hpp"
#include "rehearse/policy/tracking.hpp"

namespace rehearse::learners::gp_ilqg {

/// Where a plan ends: linear feedback for ever, and what it costs to come from beside it.
struct Hold {
  policy::FeedbackStage stage;
  Value value;  // by the planner's state less that of the stage
};

/// What is planned on. References must outlive it.
struct PlanProblem {
  const dynamics::DynamicsModel& model;
  const Task& task;  // its start's spread is not used
  const Evaluator& evaluator;
};

}  // namespace rehearse::learners::gp_ilqg
