#include "rehearse/lqr/hold.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "rehearse/lqr/linear_steps.hpp"

namespace rehearse::lqr {
namespace {

constexpr int kMostNewtonSteps = 60;
constexpr double kLargestNewtonStep = 0.3;  // of any number: cost and equation are followed, not jumped over
constexpr double kStays = 1e-7;             // the largest change of a state that stays
constexpr double kMostAction = 0.95;        // of its bound: something must be left for the feedback
constexpr double kUnseen = 1e-6;            // of the largest gain: less of it than this is none

/// A step from a state under an action, about them.
struct StepThere {
  PlannedStep step;
  Vector change;  // dx, in the model's mean
};

/// The second of two alike, so that its action was there before.
StepThere step_at(const Problem& problem, const StepCosts& costs, const Vector& state, const Vector& action,
                  double time_s) {
  Trajectory stays;
  stays.steps = 2;
  stays.begin_s = time_s - problem.task.dt_s;
  stays.states = state.transpose().replicate(3, 1);
  stays.actions = action.transpose().replicate(2, 1);
  dynamics::Linearised at;
  PlannedStep step = planned_steps(problem, costs, stays, at).back();
  return {std::move(step), at.mean.row(1).transpose()};
}

/// Derivatives by (state, actions) of the cost of staying there.
struct Staying {
  Vector gradient;
  Matrix hessian;
};

Staying staying(const PlannedStep& step, const Columns& columns) {
  const Index dx = columns.dx, du = columns.du;
  Matrix place = Matrix::Zero(columns.all(), dx + du);  // the columns of a step that stays
  place.topLeftCorner(dx, dx).setIdentity();
  place.block(columns.reached(), 0, dx, dx).setIdentity();
  place.block(columns.action(), dx, du, du).setIdentity();
  if (columns.before > 0) place.block(dx, dx, du, du).setIdentity();
  return {place.transpose() * step.cost.gradient, place.transpose() * step.cost.hessian * place};
}

/// Newton's method for the cheapest point that stays: both change at once.
bool settle(const Problem& problem, const StepCosts& costs, double time_s, Vector& state, Vector& action) {
  const Columns& columns = costs.columns();
  const Index dx = columns.dx, du = columns.du, z = dx + du;
  for (int i = 0; i < kMostNewtonSteps; ++i) {
    const auto [step, change] = step_at(problem, costs, state, action, time_s);
    const Staying at = staying(step, columns);
    if (!at.hessian.allFinite() || !step.dynamics.by.allFinite() || !change.allFinite()) return false;
    Matrix by(dx, z);  // of the change
    by << step.dynamics.by.topLeftCorner(dx, dx) - Matrix::Identity(dx, dx), step.dynamics.by.topRightCorner(dx, du);
    Matrix system = Matrix::Zero(z + dx, z + dx);
    system.topLeftCorner(z, z) = at.hessian + 1e-9 * Matrix::Identity(z, z);
    system.bottomLeftCorner(dx, z) = by;
    system.topRightCorner(z, dx) = by.transpose();
    Vector right(z + dx);
    right << -at.gradient, -change;
    const Vector solution = system.fullPivLu().solve(right);
    if (!solution.allFinite()) return false;
    Vector newton = solution.head(z);
    const double largest = newton.cwiseAbs().maxCoeff();
    if (largest > kLargestNewtonStep) newton *= kLargestNewtonStep / largest;
    state += newton.head(dx);
    action += costs.half_ranges().cwiseProduct(newton.tail(du));
    if (largest < kStays && change.cwiseAbs().maxCoeff() < kStays) break;
  }
  Matrix change(1, dx);
  problem.model.predict_mean(state.transpose(), action.transpose(), change);
  return change.cwiseAbs().maxCoeff() < 10 * kStays && costs.in_half_ranges(action).cwiseAbs().maxCoeff() < kMostAction;
}

/// Gains by states that a policy does not see become 0 where they hardly matter. False where they do.
bool needs_only_what_is_seen(const Task& task, Matrix& gain) {
  const double small = kUnseen * gain.cwiseAbs().maxCoeff();
  for (Index i = 0; i < gain.cols(); ++i) {
    if (task.states[static_cast<std::size_t>(i)].kind != StateKind::omitted) continue;
    if (gain.col(i).cwiseAbs().maxCoeff() > small) return false;
    gain.col(i).setZero();
  }
  return true;
}

/// The step for feedback by the state alone: the action before is that of the hold. Feedback that knew it and is then
/// cut off from it may be unstable.
PlannedStep without_action_before(PlannedStep step, const Columns& columns) {
  const Index dx = columns.dx, du = columns.du;
  LinearStep& f = step.dynamics;
  Matrix by(dx, dx + du);
  by << f.by.topLeftCorner(dx, dx), f.by.topRightCorner(dx, du);
  f = {.by = std::move(by), .variance = f.variance.head(dx).eval(), .variance_by = Matrix::Zero(dx, dx + du)};
  std::vector<Index> kept(static_cast<std::size_t>(columns.all() - columns.before));
  for (Index i = 0; i < std::ssize(kept); ++i) kept[static_cast<std::size_t>(i)] = i < dx ? i : i + columns.before;
  step.cost.gradient = step.cost.gradient(kept).eval();
  step.cost.hessian = step.cost.hessian(kept, kept).eval();
  return step;
}

}  // namespace

std::optional<Hold> find_hold(const Problem& problem, const StepCosts& costs, const Vector& state, const Vector& action,
                              double time_s) {
  Vector x = state, u = action;
  if (!settle(problem, costs, time_s, x, u)) return std::nullopt;
  PlannedStep step = step_at(problem, costs, x, u, time_s).step;
  step.action.setZero();
  step.cost.gradient.setZero();  // it is the cheapest point that stays
  // Feedback far within the bounds: they are as if they were not there.
  const auto found = repeated_step(without_action_before(std::move(step), costs.columns()));
  if (!found) return std::nullopt;
  Matrix gain = costs.half_ranges().asDiagonal() * found->feedback.gain;
  if (!needs_only_what_is_seen(problem.task, gain)) return std::nullopt;
  const Index n = costs.columns().planner_state(), dx = x.size();
  Value value{Vector::Zero(n), Matrix::Zero(n, n)};
  value.s.head(dx) = found->before.s;
  value.S.topLeftCorner(dx, dx) = found->before.S;
  return Hold{{u, x, std::move(gain)}, std::move(value)};
}

std::optional<Hold> find_cheapest_hold(const Problem& problem, const StepCosts& costs, const Matrix& states,
                                       const Matrix& actions, double time_s) {
  std::optional<Hold> best;
  double lowest = kInf;
  for (Index i = 0; i < states.rows(); ++i) {
    auto hold = find_hold(problem, costs, states.row(i).transpose(), actions.row(i).transpose(), time_s);
    if (!hold) continue;
    const double cost = costs.of_staying(hold->stage.state.transpose(), hold->stage.action.transpose(), time_s)(0);
    if (cost < lowest) lowest = cost, best = std::move(hold);
  }
  return best;
}

}  // namespace rehearse::lqr
