#include "rehearse/lqr/linear_steps.hpp"

namespace rehearse::lqr {

Matrix Trajectory::rows(const Columns& columns) const {
  Matrix W(steps, columns.all());
  W.leftCols(columns.dx) = states.topRows(steps);
  if (columns.before > 0 && steps > 0) {
    W.row(0).segment(columns.dx, columns.before).setZero();
    W.block(1, columns.dx, steps - 1, columns.before) = actions.topRows(steps - 1);
  }
  W.middleCols(columns.action(), columns.du) = actions;
  W.rightCols(columns.dx) = states.bottomRows(steps);
  return W;
}

Vector Trajectory::times(const Task& task) const {
  Vector times(steps);
  for (Index t = 0; t < steps; ++t) times(t) = begin_s + static_cast<double>(t) * task.dt_s;  // as rollouts have it
  return times;
}

std::vector<PlannedStep> planned_steps(const Problem& problem, const StepCosts& costs, const Trajectory& trajectory,
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

}  // namespace rehearse::lqr
