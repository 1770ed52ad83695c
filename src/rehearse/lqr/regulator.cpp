#include "rehearse/lqr/regulator.hpp"

#include <cmath>

#include <Eigen/Cholesky>

#include "rehearse/lqr/step_costs.hpp"

namespace rehearse::lqr {
namespace {

constexpr int kMostSteps = 20000;
constexpr double kUnchanged = 1e-9;  // of S, relative: a step of the recursion changes no more
constexpr double kLargestCost = 1e12;

}  // namespace

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
  const Index du = B.cols();
  if (!A.allFinite() || !B.allFinite()) return std::nullopt;
  Matrix S = weights.asDiagonal(), gain(du, A.cols());
  for (int i = 0; i < kMostSteps; ++i) {
    const Matrix SA = S * A, SB = S * B;
    const Eigen::LLT<Matrix> curvature(Matrix::Identity(du, du) + B.transpose() * SB);
    gain = -curvature.solve(B.transpose() * SA);
    Matrix next = A.transpose() * SA + SA.transpose() * B * gain;
    next.diagonal() += weights;
    next = 0.5 * (next + next.transpose()).eval();
    const double change = (next - S).cwiseAbs().maxCoeff(), size = next.cwiseAbs().maxCoeff();
    S = next;
    if (!(size < kLargestCost)) return std::nullopt;
    if (change <= kUnchanged * size) return Regulator{gain, S};
  }
  return std::nullopt;
}

}  // namespace rehearse::lqr
