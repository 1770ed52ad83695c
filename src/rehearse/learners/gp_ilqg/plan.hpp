#pragma once

#include <vector>

#include "rehearse/lqr/hold.hpp"

namespace rehearse::learners::gp_ilqg {

struct PlanOptions {
  lqr::CostOptions cost;
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
Plan improve(const lqr::Problem& problem, const PlanOptions& options, std::vector<policy::FeedbackStage> stages,
             const lqr::Hold* hold = nullptr);

}  // namespace rehearse::learners::gp_ilqg
