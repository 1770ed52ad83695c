#include "rehearse/gp/compression.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rehearse/core/linear_algebra.hpp"

namespace rehearse::gp {
namespace {

using Indices = Eigen::Matrix<Index, Eigen::Dynamic, 1>;

/// The pivoted factor of C: C ≈ L Lᵀ, rows in the order of `order`.
struct Pivoted {
  Indices order;  // n
  Matrix L;       // n × r, lower trapezoidal
};

/// Rows and columns j < p of a symmetric matrix, of which the lower triangle counts, change places. So do rows j and p
/// of the factor's columns before j.
void exchange(Matrix& C, Index j, Index p) {
  const Index n = C.rows();
  C.row(j).head(j).swap(C.row(p).head(j));
  std::swap(C(j, j), C(p, p));
  C.col(j).segment(j + 1, p - j - 1).swap(C.row(p).segment(j + 1, p - j - 1).transpose());
  C.col(j).tail(n - p - 1).swap(C.col(p).tail(n - p - 1));
}

/// The factor's columns j, one pivot after the other, until the largest diagonal that is left is at most `least`; C:
/// what is to be factorised, in its lower triangle, and then the factor. Returns the number of columns (Higham 1990, in
/// blocks: what is right of one is updated once for all of its columns).
Index factorise_pivoted(Matrix& C, double least, Indices& order) {
  constexpr Index kBlock = 32;
  const Index n = C.rows();
  Vector left = C.diagonal();
  for (Index first = 0; first < n; first += kBlock) {
    const Index end = std::min(first + kBlock, n);
    for (Index j = first; j < end; ++j) {
      Index pivot = 0;
      const double largest = left.tail(n - j).maxCoeff(&pivot);
      pivot += j;
      if (!(largest > least)) return j;
      if (pivot != j) exchange(C, j, pivot), std::swap(left(j), left(pivot)), std::swap(order(j), order(pivot));
      auto column = C.col(j).tail(n - j - 1);
      column.noalias() -= C.block(j + 1, first, n - j - 1, j - first) * C.row(j).segment(first, j - first).transpose();
      C(j, j) = std::sqrt(largest);
      column /= C(j, j);
      left.tail(n - j - 1) -= column.cwiseAbs2();
    }
    const auto block = C.block(end, first, n - end, end - first);
    add_product(C.bottomRightCorner(n - end, n - end), Sign::minus, block, block.transpose(), Part::lower);
  }
  return n;
}

/// The fewest columns that leave a trace ≤ remainder. The factorisation stops at a largest diagonal of remainder / n;
/// each column that is dropped again adds its squared norm to the trace.
std::optional<Pivoted> pivoted_cholesky(Matrix C, double remainder, Index most) {
  const Index n = C.rows();
  const double least = 0.5 * remainder / static_cast<double>(n);
  Pivoted pivoted{.order = Indices::LinSpaced(n, 0, n - 1), .L = {}};
  Index rank = factorise_pivoted(C, least, pivoted.order);
  double trace = least * static_cast<double>(n - rank);
  while (rank > 1) {
    const double column = C.col(rank - 1).tail(n - rank + 1).squaredNorm();
    if (trace + column > remainder) break;
    trace += column;
    --rank;
  }
  if (rank > most) return std::nullopt;
  pivoted.L = C.leftCols(rank);
  pivoted.L.triangularView<Eigen::StrictlyUpper>().setZero();
  return pivoted;
}

/// wᵀRw = wᵀCw − ‖Lᵀw‖² with Cw = y − ρw, and what rounding may have taken from it: of the vectors, since w is large
/// where the noise is small.
double remaining_energy(const Pivoted& pivoted, double noise_ratio, const ConstVectorView& y,
                        const ConstVectorView& weights) {
  const double all = weights.dot(y - noise_ratio * weights);
  const double explained = (pivoted.L.transpose() * weights(pivoted.order)).squaredNorm();
  const double size = y.norm() + std::sqrt(static_cast<double>(y.size()) * std::max(all, 0.0));
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * weights.norm() * size;
  return std::max(0.0, all - explained) + rounding;
}

}  // namespace

std::optional<Summary> summarise(const Matrix& C, double noise_ratio, const ConstVectorView& y,
                                 const ConstVectorView& weights, double t, Index most) {
  std::optional<Pivoted> pivoted = pivoted_cholesky(C, t * noise_ratio, most);
  if (!pivoted) return std::nullopt;
  const Matrix& L = pivoted->L;
  const Index n = L.rows(), r = L.cols(), rest = n - r;

  Matrix W = L.bottomRows(rest).transpose();  // becomes the rows of T that are not of the identity, transposed
  solve_lower_transposed(L.topRows(r), W);
  Matrix noise = Matrix::Identity(r, r);
  add_product(noise, Sign::plus, W, W.transpose(), Part::lower);
  if (!cholesky(noise)) return std::nullopt;

  Vector ordered = y(pivoted->order);
  Summary summary;
  summary.targets = ordered.head(r) + W * ordered.tail(rest);
  noise.triangularView<Eigen::Lower>().solveInPlace(summary.targets);
  noise.triangularView<Eigen::Lower>().transpose().solveInPlace(summary.targets);
  Matrix inverse = Matrix::Identity(r, r);
  solve_lower(noise, inverse);

  summary.covariance = Matrix::Zero(r, r);
  add_product(summary.covariance, Sign::plus, inverse.transpose(), inverse, Part::lower);
  add_product(summary.covariance, Sign::plus, L.topRows(r), L.topRows(r).transpose(), Part::lower, noise_ratio);
  summary.mean_error = std::sqrt(remaining_energy(*pivoted, noise_ratio, y, weights)) * (1 + std::sqrt(t));
  summary.points.assign(pivoted->order.begin(), pivoted->order.begin() + r);
  return summary;
}

Matrix probes(const Inputs& inputs) {
  const Index n = inputs.size();
  Matrix unit(4 * n, inputs.dimensions());
  for (Index i = 0; i < n; ++i) {
    const auto x = inputs.unit().row(i), next = inputs.unit().row((i + 1) % n),
               other = inputs.unit().row((i + n / 2) % n);
    unit.row(i) = x;
    unit.row(n + i) = (x + next) / 2;
    unit.row(2 * n + i) = (x + other) / 2;
    unit.row(3 * n + i) = 1.5 * x - 0.5 * other;
  }
  return (unit * inputs.half_range().asDiagonal()).rowwise() + inputs.center().transpose();
}

}  // namespace rehearse::gp
