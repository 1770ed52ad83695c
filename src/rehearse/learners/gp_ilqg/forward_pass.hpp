#pragma once

#include <vector>

#include "rehearse/lqr/hold.hpp"
#include "rehearse/lqr/linear_steps.hpp"

namespace rehearse::learners::gp_ilqg {

/// The planned steps that stages lead through in the model's mean.
struct Trajectory : lqr::Trajectory {
  double cost = kInf;      // as Plan's
  double promise = -kInf;  // as Plan's
};

/// Follows plans in the model's mean.
class ForwardPass {
 public:
  /// hold: null: none. References must outlive it.
  ForwardPass(const lqr::Problem& problem, const lqr::StepCosts& costs, const lqr::Hold* hold);

  /// Follows all plans in lockstep. They have equally many stages.
  std::vector<Trajectory> follow(const std::vector<std::vector<policy::FeedbackStage>>& plans) const;

  /// The planner's state at the end less that of the hold.
  Vector beside_hold(const Trajectory& trajectory) const;

 private:
  double cost_of(const Trajectory& trajectory, Index planned) const;

  const lqr::Problem& problem_;
  const lqr::StepCosts& costs_;
  const lqr::Hold* hold_;
  Task from_mean_start_;
};

}  // namespace rehearse::learners::gp_ilqg
