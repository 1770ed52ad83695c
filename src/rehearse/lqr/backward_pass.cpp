#include "rehearse/lqr/backward_pass.hpp"

#include <Eigen/Cholesky>

#include "rehearse/optim/box_quadratic.hpp"

namespace rehearse::lqr {
namespace {

constexpr double kNoVariance = 1e-300;
constexpr int kMostRepetitions = 20000;
constexpr double kSettled = 1e-9;  // of the cost to go, relative: a repetition changes no more
constexpr double kLargestCost = 1e12;

/// A quadratic by z = (y, u).
struct Quadratic {
  Vector gradient;
  Matrix hessian;
};

/// The cost of the step and of all that follow, by y and u.
Quadratic cost_to_go(const PlannedStep& step, const Value& after, double uncertainty) {
  const LinearStep& f = step.dynamics;
  const Index n = f.by.rows(), z = f.by.cols(), reached = step.cost.gradient.size() - z;
  Matrix to_columns(z + reached, z);  // the columns of the cost by z
  to_columns << Matrix::Identity(z, z), f.by.topRows(reached);
  Quadratic q{to_columns.transpose() * step.cost.gradient + f.by.transpose() * after.s,
              to_columns.transpose() * step.cost.hessian * to_columns + f.by.transpose() * after.S * f.by};
  for (Index i = 0; i < n && uncertainty > 0; ++i) {
    if (!(f.variance(i) > kNoVariance)) continue;
    const Vector by = f.variance_by.row(i).transpose();
    const double weight = uncertainty * curvature_at_next(step, after, i);
    q.gradient += 0.5 * weight * by;
    q.hessian +=
        weight / (4 * f.variance(i)) * by * by.transpose();  // of the standard deviation's square, to first order
  }
  return q;
}

}  // namespace

double curvature_at_next(const PlannedStep& step, const Value& after, Index i) {
  const Index z = step.dynamics.by.cols(), reached = step.cost.gradient.size() - z;
  return after.S(i, i) + (i < reached ? step.cost.hessian(z + i, z + i) : 0);
}

std::optional<BackwardStep> backward_step(const PlannedStep& step, const Value& after, double damping,
                                          double uncertainty) {
  const Index n = step.dynamics.by.rows(), du = step.action.size();
  const Quadratic q = cost_to_go(step, after, uncertainty);
  const auto q_y = q.gradient.head(n), q_u = q.gradient.tail(du);
  const auto Q_yy = q.hessian.topLeftCorner(n, n);
  const auto Q_uy = q.hessian.bottomLeftCorner(du, n);
  const auto Q_uu = q.hessian.bottomRightCorner(du, du);
  const Vector one = Vector::Ones(du);
  const auto best = optim::minimise_in_box(Q_uu + damping * Matrix::Identity(du, du), q_u, -one - step.action,
                                           one - step.action, Vector::Zero(du));
  if (!best) return std::nullopt;
  BackwardStep result{.feedback = {.open = best->x, .gain = Matrix::Zero(du, n)}, .before = {}};
  std::vector<Index> free;
  for (Index a = 0; a < du; ++a)
    if (best->free(a)) free.push_back(a);
  Matrix& gain = result.feedback.gain;
  if (!free.empty()) gain(free, Eigen::all) = -best->factor_free.solve(Matrix(Q_uy(free, Eigen::all)));
  const Vector& open = best->x;
  result.before.s = q_y + gain.transpose() * (Q_uu * open + q_u) + Q_uy.transpose() * open;
  const Matrix S = Q_yy + gain.transpose() * Q_uu * gain + gain.transpose() * Q_uy + Q_uy.transpose() * gain;
  result.before.S = 0.5 * (S + S.transpose());
  if (!result.before.S.allFinite() || !result.before.s.allFinite()) return std::nullopt;
  return result;
}

std::optional<BackwardStep> repeated_step(const PlannedStep& step) {
  const Index n = step.dynamics.by.rows();
  Value after{Vector::Zero(n), Matrix::Zero(n, n)};
  for (int i = 0; i < kMostRepetitions; ++i) {
    auto before = backward_step(step, after, 0, 0);
    if (!before) return std::nullopt;
    const Matrix& S = before->before.S;
    const double change = (S - after.S).cwiseAbs().maxCoeff(), size = S.cwiseAbs().maxCoeff();
    if (!(size < kLargestCost)) return std::nullopt;
    if (i > 0 && change <= kSettled * size) return before;
    after.S = S;
  }
  return std::nullopt;
}

std::optional<BackwardPass> backward_pass(const std::vector<PlannedStep>& steps, const Value& end, double damping,
                                          double uncertainty) {
  BackwardPass pass{.feedback = std::vector<Feedback>(steps.size()), .values = std::vector<Value>(steps.size() + 1)};
  pass.values.back() = end;
  for (std::size_t t = steps.size(); t-- > 0;) {
    auto step = backward_step(steps[t], pass.values[t + 1], damping, uncertainty);
    if (!step) return std::nullopt;
    pass.feedback[t] = std::move(step->feedback);
    pass.values[t] = std::move(step->before);
  }
  return pass;
}

}  // namespace rehearse::lqr
