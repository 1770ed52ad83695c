#include "rehearse/lqr/step_costs.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace rehearse::lqr {
namespace {

constexpr double kDifference = 1e-4;        // of a finite difference, relative to numbers above 1
constexpr double kSmallestReward = 1e-100;  // whose logarithm is taken

/// The rows that finite differences about one step need: itself, each column more and less, each pair of columns more
/// and less together.
class Differences {
 public:
  explicit Differences(Index columns) : columns_(columns) {}

  Index rows() const { return 1 + 2 * columns_ + columns_ * (columns_ - 1); }
  static Index more(Index i) { return 1 + 2 * i; }
  Index both_more(Index i, Index j) const {  // i < j
    const Index pair = i * (2 * columns_ - i - 1) / 2 + j - i - 1;
    return 1 + 2 * columns_ + 2 * pair;
  }

  /// About w with steps h: rows() × columns.
  void surround(const Vector& w, const Vector& h, MatrixView W) const {
    W.rowwise() = w.transpose();
    for (Index i = 0; i < columns_; ++i) {
      W(more(i), i) += h(i);
      W(more(i) + 1, i) -= h(i);
      for (Index j = i + 1; j < columns_; ++j)
        for (const Index k : {i, j}) {
          W(both_more(i, j), k) += h(k);
          W(both_more(i, j) + 1, k) -= h(k);
        }
    }
  }

  Expansion expansion(const ConstVectorView& c, const Vector& h) const {
    Expansion at{.value = c(0), .gradient = Vector(columns_), .hessian = Matrix(columns_, columns_)};
    for (Index i = 0; i < columns_; ++i) {
      const double sum = c(more(i)) + c(more(i) + 1);
      at.gradient(i) = (c(more(i)) - c(more(i) + 1)) / (2 * h(i));
      at.hessian(i, i) = (sum - 2 * c(0)) / (h(i) * h(i));
      for (Index j = i + 1; j < columns_; ++j) {
        const double both = c(both_more(i, j)) + c(both_more(i, j) + 1), other = c(more(j)) + c(more(j) + 1);
        at.hessian(i, j) = at.hessian(j, i) = (both - sum - other + 2 * c(0)) / (2 * h(i) * h(j));
      }
    }
    return at;
  }

 private:
  Index columns_;
};

/// The nearest one that curves upwards in every direction.
Matrix without_negative_curvature(const Matrix& hessian) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(hessian);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

StepCosts::StepCosts(const Task& task, const CostOptions& options)
    : task_(task), columns_(task), options_(options), middle_(columns_.du), half_(columns_.du) {
  for (Index a = 0; a < columns_.du; ++a) {
    const Interval& bounds = task.actions[static_cast<std::size_t>(a)].bounds;
    middle_(a) = 0.5 * (bounds.low + bounds.high);
    half_(a) = 0.5 * (bounds.high - bounds.low);
  }
}

double StepCosts::of_floor() const {
  return options_.scale == CostScale::linear ? -task_.reward_floor
                                             : -std::log(std::max(task_.reward_floor, kSmallestReward));
}

void StepCosts::evaluate(const ConstMatrixView& W, const Vector& times_s, VectorView costs) const {
  const auto X = W.leftCols(columns_.dx), U = W.middleCols(columns_.action(), columns_.du),
             next = W.middleCols(columns_.reached(), columns_.dx);
  task_.reward(X, U, next, costs);
  if (options_.scale == CostScale::logarithmic)
    costs = costs.unaryExpr([](double r) { return -std::log(std::max(r, kSmallestReward)); });
  else
    costs = -costs;
  if (task_.cost) add_step_costs(W, times_s, costs);
  for (Index a = 0; a < columns_.du; ++a)
    costs.array() += options_.action_cost * ((U.col(a).array() - middle_(a)) / half_(a)).square();
  costs = costs.unaryExpr([](double c) { return std::isfinite(c) ? c : kInf; });
}

void StepCosts::add_step_costs(const ConstMatrixView& W, const Vector& times_s, VectorView costs) const {
  const Index n = W.rows();
  Vector some(n);
  for (Index first = 0, end = 0; first < n; first = end) {  // a call has one time
    while (end < n && times_s(end) == times_s(first)) ++end;
    const auto part = W.middleRows(first, end - first);
    task_.cost({part.leftCols(columns_.dx), part.middleCols(columns_.action(), columns_.du),
                part.middleCols(columns_.reached(), columns_.dx), part.middleCols(columns_.dx, columns_.before),
                times_s(first)},
               some.segment(first, end - first));
  }
  costs += options_.task_costs * some;
}

Vector StepCosts::of_staying(const ConstMatrixView& states, const ConstMatrixView& actions, double time_s) const {
  Matrix W(states.rows(), columns_.all());
  W << states, actions.leftCols(columns_.before), actions, states;
  Vector costs(W.rows());
  evaluate(W, Vector::Constant(W.rows(), time_s), costs);
  return costs;
}

std::vector<Expansion> StepCosts::expand(const ConstMatrixView& W, const Vector& times_s) const {
  const Differences differences(columns_.all());
  const Index n = W.rows(), rows = differences.rows();
  Matrix H(n, columns_.all()), around(n * rows, columns_.all());
  Vector times(n * rows), costs(n * rows), unit = Vector::Ones(columns_.all());
  unit.segment(columns_.action(), columns_.du) = half_;
  unit.segment(columns_.dx, columns_.before) = half_.head(columns_.before);
  for (Index t = 0; t < n; ++t) {
    H.row(t) = kDifference * unit.transpose().cwiseMax(W.row(t).cwiseAbs());
    differences.surround(W.row(t), H.row(t), around.middleRows(t * rows, rows));
    times.segment(t * rows, rows).setConstant(times_s(t));
  }
  evaluate(around, times, costs);
  std::vector<Expansion> all;
  for (Index t = 0; t < n; ++t) {
    Expansion at = differences.expansion(costs.segment(t * rows, rows), H.row(t));
    at.gradient.array() *= unit.array();
    at.hessian = unit.asDiagonal() * at.hessian * unit.asDiagonal();
    if (at.hessian.allFinite()) at.hessian = without_negative_curvature(at.hessian);
    all.push_back(std::move(at));
  }
  return all;
}

}  // namespace rehearse::lqr
