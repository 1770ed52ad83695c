#include "rehearse/gp/compression.hpp"

#include <gtest/gtest.h>

#include "naive.hpp"

namespace rehearse::gp {
namespace {

Hyperparameters unit_signal(Index dimensions, double length, double noise) {
  return naive::hyperparameters(dimensions, length, 1, noise);
}

struct Conditional {
  Vector mean, deviation;
};

Vector weights(const Matrix& X, const Hyperparameters& theta, const Vector& y) {
  return naive::noisy_covariance(X, theta).llt().solve(y);
}

/// K: covariance of the targets, k: that of the targets with the queries.
Conditional condition(const Matrix& K, const Matrix& k, const Vector& y) {
  const Eigen::LLT<Matrix> llt(K);
  const Vector explained = llt.matrixL().solve(k).colwise().squaredNorm();
  return {k.transpose() * llt.solve(y), (1 - explained.array()).max(0).sqrt()};
}

Conditional condition(const Summary& summary, const Matrix& X, const Matrix& F, const Hyperparameters& theta) {
  const Matrix K = summary.covariance.selfadjointView<Eigen::Lower>();
  return condition(K, naive::covariance(X(summary.points, Eigen::all), F, theta), summary.targets);
}

TEST(Summarise, CopiesOfAPointBecomeOneWithTheirMeanAndLessNoise) {
  const Index distinct = 5, copies = 4;
  const Matrix points = naive::normals(distinct, 2, 1);
  const Hyperparameters theta = unit_signal(2, 1, 0.3);
  const Matrix X = points.replicate(copies, 1);
  const Vector y = naive::normals(distinct * copies, 1, 2);
  const auto summary =
      summarise(naive::covariance(X, X, theta), 0.09, y, weights(X, theta, y), 1e-8, distinct * copies);
  ASSERT_TRUE(summary);
  ASSERT_EQ(summary->points.size(), distinct);
  const Matrix C = naive::covariance(points, points, theta) + 0.09 / copies * Matrix::Identity(distinct, distinct);
  const Vector means = y.reshaped(distinct, copies).rowwise().mean();
  for (Index i = 0; i < distinct; ++i) {
    const Index point = summary->points[static_cast<std::size_t>(i)] % distinct;
    EXPECT_NEAR(summary->targets(i), means(point), 1e-9);
    for (Index j = 0; j <= i; ++j)
      EXPECT_NEAR(summary->covariance(i, j), C(point, summary->points[static_cast<std::size_t>(j)] % distinct), 1e-9);
  }
}

TEST(Summarise, StaysWithinItsBound) {
  const Matrix X = naive::normals(150, 3, 3);
  Matrix F(400, 3);
  F << naive::normals(200, 3, 4), X, 5 * naive::normals(50, 3, 5);
  for (const double noise : {1.0, 0.1, 0.01}) {
    for (const double t : {1e-1, 1e-3, 1e-5}) {
      const Hyperparameters theta = unit_signal(3, 2, noise);
      const double ratio = noise * noise;
      const Vector y = naive::draw(X, theta, 6);
      const auto summary = summarise(naive::covariance(X, X, theta), ratio, y, weights(X, theta, y), t, 150);
      ASSERT_TRUE(summary);
      EXPECT_LT(summary->points.size(), 150);
      const Conditional exact = condition(naive::noisy_covariance(X, theta), naive::covariance(X, F, theta), y);
      const Conditional few = condition(*summary, X, F, theta);
      const Eigen::ArrayXd bound = (t + std::sqrt(t)) * few.deviation.array() + 1e-9;
      EXPECT_TRUE(((few.deviation - exact.deviation).array().abs() <= bound).all()) << noise << " " << t;
      EXPECT_LE((few.mean - exact.mean).cwiseAbs().maxCoeff(), summary->mean_error + 1e-9) << noise << " " << t;
    }
  }
}

TEST(Summarise, NeedsFewerPointsTheMoreNoiseThereIs) {
  const Matrix X = naive::normals(200, 2, 7);
  std::size_t before = 201;
  for (const double noise : {0.01, 0.1, 1.0}) {
    const Hyperparameters theta = unit_signal(2, 1, noise);
    const Vector zero = Vector::Zero(200);
    const auto summary = summarise(naive::covariance(X, X, theta), noise * noise, zero, zero, 1e-3, 200);
    ASSERT_TRUE(summary);
    EXPECT_LT(summary->points.size(), before);
    before = summary->points.size();
  }
}

TEST(Summarise, RefusesWhenTooManyPointsAreNeeded) {
  const Matrix X = naive::normals(60, 7, 8);
  const Matrix C = naive::covariance(X, X, unit_signal(7, 0.5, 0.1));
  EXPECT_FALSE(summarise(C, 0.01, Vector::Zero(60), Vector::Zero(60), 1e-3, 45));
}

}  // namespace
}  // namespace rehearse::gp
