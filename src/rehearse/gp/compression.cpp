#include "rehearse/gp/compression.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rehearse/optim/blas.hpp"

namespace rehearse::gp {
namespace {

/// The pivoted factor of C: C ≈ L Lᵀ, rows in the order of `order`.
struct Pivoted {
  std::vector<Index> order;  // n
  Matrix L;                  // n × r, lower trapezoidal
};

/// As few columns as leave a trace ≤ remainder. The factorisation stops at a largest diagonal of remainder / n; each
/// column that is dropped again adds its squared norm to the trace.
std::optional<Pivoted> pivoted_cholesky(Matrix C, double remainder, Index most) {
  const int n = static_cast<int>(C.rows());
  const double pivot = 0.5 * remainder / n;
  std::vector<int> order(static_cast<std::size_t>(n));
  Vector work(2 * n);
  int rank = 0, info = 0;
  dpstrf_("L", &n, C.data(), &n, order.data(), &rank, &pivot, work.data(), &info);
  if (info < 0) return std::nullopt;
  double trace = pivot * (n - rank);
  while (rank > 1) {
    const double column = C.col(rank - 1).tail(n - rank + 1).squaredNorm();
    if (trace + column > remainder) break;
    trace += column;
    --rank;
  }
  if (rank > most) return std::nullopt;
  Pivoted pivoted{.order = {}, .L = C.leftCols(rank)};
  for (const int row : order) pivoted.order.push_back(row - 1);
  pivoted.L.triangularView<Eigen::StrictlyUpper>().setZero();
  return pivoted;
}

/// wᵀRw = wᵀCw − ‖Lᵀw‖² with Cw = y − ρw, and what rounding may have taken from it.
double remaining_energy(const Pivoted& pivoted, double noise_ratio, const ConstVectorView& y,
                        const ConstVectorView& weights) {
  const double all = weights.dot(y - noise_ratio * weights);
  const double explained = (pivoted.L.transpose() * weights(pivoted.order)).squaredNorm();
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * static_cast<double>(y.size()) * all;
  return std::max(0.0, all - explained) + rounding;
}

}  // namespace

std::optional<Summary> summarise(const Matrix& C, double noise_ratio, const ConstVectorView& y,
                                 const ConstVectorView& weights, double t, Index most) {
  optim::use_one_blas_thread();
  std::optional<Pivoted> pivoted = pivoted_cholesky(C, t * noise_ratio, most);
  if (!pivoted) return std::nullopt;
  const Matrix& L = pivoted->L;
  const int n = static_cast<int>(L.rows()), r = static_cast<int>(L.cols()), rest = n - r;
  const double one = 1, zero = 0;

  Matrix W = L.bottomRows(rest);  // becomes the rows of T that are not of the identity
  if (rest > 0) dtrsm_("R", "L", "N", "N", &rest, &r, &one, L.data(), &n, W.data(), &rest);
  Matrix noise = Matrix::Identity(r, r);
  if (rest > 0) dsyrk_("L", "T", &r, &rest, &one, W.data(), &rest, &one, noise.data(), &r);
  int info = 0;
  dpotrf_("L", &r, noise.data(), &r, &info);
  if (info != 0) return std::nullopt;

  Vector ordered = y(pivoted->order);
  Summary summary;
  summary.targets = ordered.head(r) + W.transpose() * ordered.tail(rest);
  noise.triangularView<Eigen::Lower>().solveInPlace(summary.targets);
  noise.triangularView<Eigen::Lower>().transpose().solveInPlace(summary.targets);
  dpotri_("L", &r, noise.data(), &r, &info);

  summary.covariance.resize(r, r);
  dsyrk_("L", "N", &r, &r, &one, L.data(), &n, &zero, summary.covariance.data(), &r);
  summary.covariance.triangularView<Eigen::Lower>() += noise_ratio * noise;
  summary.mean_error = std::sqrt(remaining_energy(*pivoted, noise_ratio, y, weights)) * (1 + std::sqrt(t));
  summary.points.assign(pivoted->order.begin(), pivoted->order.begin() + r);
  return summary;
}

}  // namespace rehearse::gp
