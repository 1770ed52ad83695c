#include "rehearse/identification/misfit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rehearse/gp/evidence.hpp"

namespace rehearse::identification {
namespace {

struct Predictable {
  double misfit;
  Vector mean;
};

/// Mean square of y less that of its errors of leave-one-out predictions (Rasmussen 2006, eq. 5.12), a degree of
/// freedom of the GP, which has the trace of (K − σ_n² I) K⁻¹. The posterior mean is y − σ_n² K⁻¹ y.
Predictable predictable(const gp::Whitening& whiten, const ConstVectorView& y, double noise_variance) {
  const Matrix inverse_factor = whiten(Matrix::Identity(y.size(), y.size()));
  const Vector weights = inverse_factor.transpose() * whiten(y).col(0);
  const Vector precisions = inverse_factor.colwise().squaredNorm();
  const double errors = weights.cwiseQuotient(precisions).squaredNorm();
  const auto n = static_cast<double>(y.size());
  const double freedom = std::max(1.0, n - noise_variance * precisions.sum());
  return {std::max(0.0, y.squaredNorm() - errors) / (n * freedom), y - noise_variance * weights};
}

}  // namespace

Spread spread_of_gp(const gp::Inputs& inputs, const gp::Hyperparameters& kernel, const ConstVectorView& y) {
  gp::Whitening whiten(inputs, kernel);
  auto [misfit, mean] = predictable(whiten, y, kernel.noise_variance());
  return {std::move(whiten), misfit, std::move(mean)};
}

std::vector<Index> nearest_rows(const gp::Inputs& inputs) {
  const Matrix X = (inputs.unit() * inputs.half_range().cwiseQuotient(inputs.spread()).asDiagonal()).transpose();
  std::vector<Index> nearest(static_cast<std::size_t>(X.cols()));
  for (Index i = 0; i < X.cols(); ++i) {
    Vector distances = (X.colwise() - X.col(i)).colwise().squaredNorm();
    distances(i) = kInf;
    distances.minCoeff(&nearest[static_cast<std::size_t>(i)]);
  }
  return nearest;
}

Spread spread_of_white(const ConstVectorView& y, double scale, Index parameters, const std::vector<Index>& nearest) {
  const double n = static_cast<double>(y.size());
  const double floor = kLeastDeviation * gp::usable_scale(scale);
  const double variance = y.squaredNorm() / std::max(n - static_cast<double>(parameters), 1.0);
  const double deviation = std::sqrt(std::max(variance, floor * floor));
  const double white = 0.5 * (y - y(nearest)).squaredNorm();
  return {[deviation](const Matrix& Y) { return Matrix(Y / deviation); }, std::max(0.0, y.squaredNorm() - white) / n};
}

}  // namespace rehearse::identification
