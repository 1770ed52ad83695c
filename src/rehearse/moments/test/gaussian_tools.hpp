#pragma once
// Checks of moments and adjoints, for every room that has some.

#include <cmath>
#include <functional>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"
#include "rehearse/moments/gaussian.hpp"

namespace rehearse::tools {

using moments::Gaussian, moments::Transformed;

inline Matrix normals(Index rows, Index columns, std::uint64_t seed) {
  Rng rng({.seed = seed});
  return Matrix::NullaryExpr(rows, columns, [&] { return rng.normal(); });
}

/// A Gaussian with a covariance of full rank, about `scale` in size.
inline Gaussian random_gaussian(Index size, double scale, std::uint64_t seed) {
  const Matrix A = normals(size, size, seed + 1000);
  return {normals(size, 1, seed), scale / static_cast<double>(size) * (A * A.transpose())};
}

inline Transformed random_adjoint(Index inputs, Index outputs, std::uint64_t seed) {
  return {normals(outputs, 1, seed), normals(outputs, outputs, seed + 1), normals(inputs, outputs, seed + 2)};
}

inline double inner(const Transformed& adjoint, const Transformed& value) {
  return adjoint.mean.dot(value.mean) + adjoint.covariance.cwiseProduct(value.covariance).sum() +
         adjoint.gain.cwiseProduct(value.gain).sum();
}

/// ∂f/∂x by central differences of fourth order.
inline double slope(const std::function<double(double)>& f, double step) {
  return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step);
}

inline Vector slopes(const std::function<double(const Vector&)>& f, const Vector& x, double step) {
  return Vector::NullaryExpr(
      x.size(), [&](Index i) { return slope([&](double h) { return f(x + h * Vector::Unit(x.size(), i)); }, step); });
}

/// Compares an adjoint with differences of f: those by the mean, and those by the entries of a covariance that stays
/// symmetric, relative to the largest.
inline void expect_slopes(const std::function<double(const Gaussian&)>& f, const Gaussian& x, const Gaussian& adjoint,
                          double step = 1e-3, double tolerance = 1e-7) {
  const Vector by_mean = slopes([&](const Vector& mean) { return f({mean, x.covariance}); }, x.mean, step);
  EXPECT_LT((by_mean - adjoint.mean).lpNorm<Eigen::Infinity>(), tolerance * (1 + by_mean.lpNorm<Eigen::Infinity>()));
  const Matrix symmetric = adjoint.covariance + adjoint.covariance.transpose();
  Matrix by_covariance(x.size(), x.size());
  for (Index i = 0; i < x.size(); ++i)
    for (Index j = 0; j < x.size(); ++j)
      by_covariance(i, j) = slope(
          [&](double h) {
            Gaussian moved = x;
            moved.covariance(i, j) += h;
            moved.covariance(j, i) += h;
            return f(moved);
          },
          step * x.covariance.diagonal().minCoeff());
  EXPECT_LT((by_covariance - symmetric).cwiseAbs().maxCoeff(), tolerance * (1 + by_covariance.cwiseAbs().maxCoeff()));
}

/// Compares moments with those of 200 000 samples of f(x, draw), where `draw` has E numbers N(0, 1) for functions that
/// are random themselves. Every entry of mean, covariance and cov[x, f] must be within 5 of its standard errors: with
/// some 50 entries the probability of a false alarm is 3·10⁻⁵.
inline void expect_samples(const std::function<Vector(const Vector& x, const Vector& draw)>& f, const Gaussian& x,
                           const Transformed& expected, std::uint64_t seed) {
  constexpr Index kSamples = 200000;
  const Index D = x.size(), E = expected.outputs();
  const Matrix L = x.covariance.llt().matrixL();
  Rng rng({.seed = seed});
  const auto draw = [&](Index n) { return Vector::NullaryExpr(n, [&] { return rng.normal(); }); };
  Matrix samples(D + E, kSamples);  // deviations from the means that are expected
  for (Index k = 0; k < kSamples; ++k) {
    const Vector deviation = L * draw(D);
    samples.col(k) << deviation, f(x.mean + deviation, draw(E)) - expected.mean;
  }
  const auto check = [](const Eigen::ArrayXd& values, double mean, const char* what) {
    const double n = static_cast<double>(values.size());
    const double error = std::sqrt((values - values.mean()).square().mean() / n);
    EXPECT_NEAR(values.mean(), mean, 5 * error + 1e-12) << what;
  };
  const Matrix cross = x.covariance * expected.gain;
  for (Index e = 0; e < E; ++e) {
    const auto y = samples.row(D + e).transpose().array();
    check(y, 0, "mean");
    for (Index o = 0; o <= e; ++o)
      check(y * samples.row(D + o).transpose().array(), expected.covariance(e, o), "covariance");
    for (Index d = 0; d < D; ++d) check(y * samples.row(d).transpose().array(), cross(d, e), "gain");
  }
}

}  // namespace rehearse::tools
