#include "rehearse/learners/gp_ilqg/linear_steps.hpp"

namespace rehearse::learners::gp_ilqg {

std::vector<PlannedStep> planned_steps(const PlanProblem& problem, const StepCosts& costs, const Trajectory& trajectory,
                                       dynamics::Linearised& at) {
  const Columns& columns = costs.columns();
  const Index dx = columns.dx, du = columns.du, n = columns.planner_state(), inputs = dx + du;
  problem.model.linearise(trajectory.states.topRows(trajectory.steps), trajectory.actions, at);
  std::vector<Expansion> expansions = costs.expand(trajectory.rows(columns), trajectory.times(problem.task));
  std::vector<PlannedStep> steps(expansions.size());
  for (Index t = 0; t < trajectory.steps; ++t) {
    PlannedStep& step = steps[static_cast<std::size_t>(t)];
    LinearStep& f = step.dynamics;
    f.by.setZero(n, n + du);
    f.variance.setZero(n);
    f.variance_by.setZero(n, n + du);
    const auto place = [&](const Matrix& derivatives, Matrix& by) {
      for (Index i = 0; i < dx; ++i) {
        by.row(i).head(dx) = derivatives.row(t).segment(i * inputs, dx);
        by.row(i).tail(du) =
            derivatives.row(t).segment(i * inputs + dx, du).cwiseProduct(costs.half_ranges().transpose());
      }
    };
    place(at.mean_by, f.by);
    place(at.variance_by, f.variance_by);
    f.by.topLeftCorner(dx, dx) += Matrix::Identity(dx, dx);
    if (columns.before > 0) f.by.bottomRightCorner(du, du).setIdentity();
    f.variance.head(dx) = at.variance.row(t).transpose();
    step.cost = std::move(expansions[static_cast<std::size_t>(t)]);
    step.action = costs.in_half_ranges(trajectory.actions.row(t).transpose());
  }
  return steps;
}

}  // namespace rehearse::learners::gp_ilqg
