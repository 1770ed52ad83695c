#include "rehearse/lqr/regulator.hpp"

#include <utility>

#include "rehearse/lqr/backward_pass.hpp"
#include "rehearse/lqr/step_costs.hpp"

namespace rehearse::lqr {

LinearSystem linear_system(const Problem& problem, const Vector& state, const Vector& action) {
  const Index dx = state.size(), du = action.size();
  dynamics::Linearised at;
  problem.model.linearise(state.transpose(), action.transpose(), at);
  const Matrix by = at.mean_by.reshaped(dx + du, dx).transpose();  // one row
  return {.A = Matrix::Identity(dx, dx) + by.leftCols(dx),
          .B = by.rightCols(du) * StepCosts(problem.task, {}).half_ranges().asDiagonal()};
}

std::optional<Regulator> regulate(const LinearSystem& system, const Vector& weights) {
  const auto& [A, B] = system;
  const Index dx = A.rows(), du = B.cols(), z = dx + du;
  if (!A.allFinite() || !B.allFinite()) return std::nullopt;
  PlannedStep step;
  step.dynamics = {.by = Matrix(dx, z), .variance = Vector::Zero(dx), .variance_by = Matrix::Zero(dx, z)};
  step.dynamics.by << A, B;
  step.cost.gradient = Vector::Zero(z);
  step.cost.hessian = Matrix::Identity(z, z);
  step.cost.hessian.diagonal().head(dx) = weights;
  step.action = Vector::Zero(du);
  auto found = repeated_step(step);
  if (!found) return std::nullopt;
  return Regulator{std::move(found->feedback.gain), std::move(found->before.S)};
}

}  // namespace rehearse::lqr
