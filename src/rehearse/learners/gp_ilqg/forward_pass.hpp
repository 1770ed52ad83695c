#pragma once

#include <vector>

#include "rehearse/learners/gp_ilqg/plan_problem.hpp"
#include "rehearse/learners/gp_ilqg/step_costs.hpp"

namespace rehearse::learners::gp_ilqg {

/// The states that stages lead through in the model's mean.
struct Trajectory {
  Matrix states, actions;  // steps + 1 × dx, steps × du, of the planned steps
  Index steps = 0;         // made before an early end
  double begin_s = 0;      // when the first step begins
  double cost = kInf;      // as Plan's
  double promise = -kInf;  // as Plan's

  /// The planned steps as rows (steps × columns), and when each begins.
  Matrix rows(const Columns& columns) const;
  Vector times(const Task& task) const;
};

/// Follows plans in the model's mean.
class ForwardPass {
 public:
  /// hold: null: none. References must outlive it.
  ForwardPass(const PlanProblem& problem, const StepCosts& costs, const Hold* hold);

  /// Follows all plans in lockstep. They have equally many stages.
  std::vector<Trajectory> follow(const std::vector<std::vector<policy::FeedbackStage>>& plans) const;

  /// The planner's state at the end less that of the hold.
  Vector beside_hold(const Trajectory& trajectory) const;

 private:
  double cost_of(const Trajectory& trajectory, Index planned) const;

  const PlanProblem& problem_;
  const StepCosts& costs_;
  const Hold* hold_;
  Task from_mean_start_;
};

/// a − b, angles the shorter way round.
Vector state_difference(const Task& task, const ConstVectorView& a, const ConstVectorView& b);

}  // namespace rehearse::learners::gp_ilqg
