#include "rehearse/gp/slope_chunk.hpp"

#include <gtest/gtest.h>

#include "naive.hpp"
#include "rehearse/gp/posterior.hpp"

namespace rehearse::gp {
namespace {

/// Derivatives against central differences, and values against predictions, which have the same bits.
void expect_slopes(const Posterior& posterior, const Matrix& F) {
  const Index D = posterior.dimensions(), E = posterior.outputs(), rows = F.rows();
  Matrix mean(rows, E), variance(rows, E), mean_by(rows, E * D), variance_by(rows, E * D);
  posterior.linearise(F, mean, variance, mean_by, variance_by);
  Matrix means(rows, E), variances(rows, E);
  posterior.predict(F, means, variances);
  EXPECT_EQ(mean, means);
  EXPECT_EQ(variance, variances);
  const double h = 1e-5;
  for (Index d = 0; d < D; ++d) {
    Matrix more = F, less = F;
    more.col(d).array() += h;
    less.col(d).array() -= h;
    Matrix mean_more(rows, E), variance_more(rows, E);
    posterior.predict(more, mean_more, variance_more);
    posterior.predict(less, means, variances);
    for (Index e = 0; e < E; ++e) {
      const auto expect = [&](const Vector& slope, const Vector& difference) {
        EXPECT_LT((slope - difference / (2 * h)).cwiseAbs().maxCoeff(), 1e-5 * (1 + slope.cwiseAbs().maxCoeff()));
      };
      expect(mean_by.col(e * D + d), (mean_more - means).col(e));
      expect(variance_by.col(e * D + d), (variance_more - variances).col(e));
    }
  }
}

TEST(SlopeChunk, IsThatOfThePredictions) {
  const Matrix X = naive::normals(40, 3, 1);
  expect_slopes(Posterior(Inputs(X), naive::normals(40, 2, 2),
                          {naive::hyperparameters(3, 1, 2, 0.1), naive::hyperparameters(3, 3, 0.5, 0.01)}),
                naive::normals(150, 3, 8));
}

TEST(SlopeChunk, KnowsWhatFewPointsSumUp) {
  const Matrix X = naive::normals(220, 2, 17);
  const std::vector<Hyperparameters> thetas = {naive::hyperparameters(2, 2, 1, 0.5),
                                               naive::hyperparameters(2, 2, 2, 0.02)};
  Matrix Y(220, 2);
  for (Index e = 0; e < 2; ++e) Y.col(e) = naive::draw(X, thetas[static_cast<std::size_t>(e)], 18);
  const Posterior few(Inputs(X), Y, thetas, 0.01);
  EXPECT_LT(few.variance_points(0), 60);
  expect_slopes(few, naive::normals(150, 2, 8));
}

TEST(SlopeChunk, KnowsTrends) {
  const Matrix X = naive::normals(60, 3, 17).array() + 0.5;
  const Hyperparameters theta = naive::with_trend(naive::hyperparameters(3, 2, 1, 0.3), 0.4);
  const Vector y = naive::draw(X, theta, 18);
  for (const double tolerance : {0.0, 0.01})
    expect_slopes(Posterior(Inputs(X), y, {theta}, tolerance), 2 * naive::normals(150, 3, 8));
}

TEST(SlopeChunk, KnowsTheTrendOfAFunctionWithoutPoints) {
  const Matrix X = naive::normals(60, 1, 17);
  const Hyperparameters theta = naive::with_trend(naive::hyperparameters(1, 1, 1e-6, 1), 1e-5);
  const Posterior none(Inputs(X), naive::normals(60, 1, 18), {theta}, 0.01);
  EXPECT_EQ(none.variance_points(0), 0);
  const double x = 1e6, h = 100;
  Matrix mean(2, 1), variance(2, 1), mean_by(2, 1), variance_by(2, 1);
  none.predict(Matrix{{x - h}, {x + h}}, mean, variance);
  const double difference = (variance(1) - variance(0)) / (2 * h);
  none.linearise(Matrix{{x}, {x}}, mean, variance, mean_by, variance_by);
  EXPECT_GT(difference, 1e-6);
  EXPECT_NEAR(variance_by(0), difference, 1e-6 * difference);
}

TEST(SlopeChunk, KnowsOddFunctions) {
  const Matrix X = naive::normals(220, 3, 17).array() + 0.5;
  const Vector signs{{-1, 1, -1}};
  for (const double trend : {0.0, 0.4}) {
    Hyperparameters theta = naive::hyperparameters(3, 2, 1, 0.3);
    if (trend > 0) theta = naive::with_trend(theta, trend);
    const Vector y = naive::draw(X, theta, 18);
    const Posterior all(Inputs(X), y, {theta}, 0, signs), few(Inputs(X), y, {theta}, 0.01, signs);
    EXPECT_LT(few.variance_points(0), 220);
    for (const Posterior* posterior : {&all, &few}) expect_slopes(*posterior, naive::normals(150, 3, 8));
  }
}

TEST(SlopeChunk, AMissingRowDisturbsNoOther) {
  const Posterior posterior(Inputs(Matrix{{0.0}, {1.0}}), Matrix{{1.0}, {-1.0}},
                            {{.log_lengths = Vector::Zero(1), .log_signal = 0, .log_noise = -40}});
  const Matrix F{{0.0}, {kNaN}, {0.5}};
  Matrix mean(3, 1), variance(3, 1), mean_by(3, 1), variance_by(3, 1);
  posterior.linearise(F, mean, variance, mean_by, variance_by);
  EXPECT_TRUE(std::isnan(mean_by(1, 0)) && std::isnan(variance_by(1, 0)));
  EXPECT_NEAR(mean_by(2, 0), (mean(2, 0) - 1) / 0.5, 1) << "the row beside it is not disturbed";
  EXPECT_TRUE(std::isfinite(variance_by(0, 0)));
}

}  // namespace
}  // namespace rehearse::gp
