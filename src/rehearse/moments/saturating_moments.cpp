#include "rehearse/moments/saturating_moments.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace rehearse::moments {
namespace {

/// E[exp(−½ yᵀ y)] of y ~ N(m, s) is exp(−½ mᵀ (I + s)⁻¹ m) / √det(I + s).
struct Expectation {
  Expectation(const Vector& m, const Matrix& s) {
    const Eigen::LLT<Matrix> llt(Matrix::Identity(m.size(), m.size()) + s);
    if (llt.info() != Eigen::Success || !m.allFinite()) return;
    inverse = llt.solve(Matrix::Identity(m.size(), m.size()));
    towards = inverse * m;
    value = std::exp(-m.dot(towards) / 2) / llt.matrixLLT().diagonal().prod();
  }
  double value = kNaN;
  Matrix inverse;  // (I + s)⁻¹
  Vector towards;  // (I + s)⁻¹ m
};

}  // namespace

RewardMoments saturating_moments(const reward::ClosedForm& reward, const Gaussian& features) {
  const Matrix& U = reward.distances;
  const Vector m = U * (features.mean - reward.goal);
  const Matrix s = U * features.covariance * U.transpose();
  const Expectation first(m, s), second(std::sqrt(2.0) * m, 2 * s);
  RewardMoments moments{.mean = first.value, .by_mean = Gaussian::zero(features.size())};
  moments.variance = second.value - first.value * first.value;
  if (!std::isfinite(first.value)) return moments;
  moments.variance = std::max(0.0, moments.variance);
  moments.by_mean.mean = -first.value * (U.transpose() * first.towards);
  moments.by_mean.covariance =
      first.value / 2 * (U.transpose() * (first.towards * first.towards.transpose() - first.inverse) * U);
  return moments;
}

}  // namespace rehearse::moments
