#pragma once

#include <optional>
#include <vector>

#include "rehearse/core/evaluator.hpp"
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

struct PlanOptions {
  CostOptions cost;
  double uncertainty = 1;
  Index iterations = 100;
};

/// A plan and what it is worth in the model's mean.
struct Plan {
  std::vector<policy::FeedbackStage> stages;  // one a planned step, and one that holds
  Matrix states;                              // steps + 1 × dx, that the policy goes through
  double cost = kInf;                         // of its planned steps, and of what follows if there is a hold
  double promise = -kInf;                     // of the whole episode, if its last planned step could be repeated
  Index steps = 0;                            // made before an early end, if it has one
};

/// Iterative LQG with bounds of the actions: improves a plan until nothing is left to gain (Li 2004; Tassa 2014; with
/// the model's uncertainty, Lee 2017). The policy is followed in the model's mean with its feedback, ten step lengths
/// at once. `stages` holds where to begin. hold: null, or where the plan is to end. Deterministic; any thread.
Plan improve(const PlanProblem& problem, const PlanOptions& options, std::vector<policy::FeedbackStage> stages,
             const Hold* hold = nullptr);

/// Stages that take these actions (steps × du) whatever happens.
std::vector<policy::FeedbackStage> open_loop(const Task& task, const ConstMatrixView& actions);

}  // namespace rehearse::learners::gp_ilqg
