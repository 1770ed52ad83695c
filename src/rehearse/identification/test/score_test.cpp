#include "rehearse/identification/score.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "scores.hpp"

namespace rehearse::identification {
namespace {

TEST(ScoreOf, AgreesWithTheFormulas) {
  const Vector log_p{{-1.5, 0.3, 2}};
  const Eigen::ArrayXd p = log_p.array().exp();
  EXPECT_NEAR(score_of(log_p, Score::sum), std::log(p.sum()), 1e-14);
  EXPECT_NEAR(score_of(log_p, Score::product), std::log(p.prod()), 1e-14);
  EXPECT_NEAR(score_of(log_p, Score::harmonic), std::log(3 / (1 / p).sum()), 1e-14);
}

TEST(ScoreOf, NeitherOverflowsNorUnderflows) {
  const Vector far{{1e5, -1e5, 1e5 - 1}};
  EXPECT_NEAR(score_of(far, Score::sum), 1e5 + std::log1p(std::exp(-1.0)), 1e-9);
  EXPECT_NEAR(score_of(far, Score::product), 1e5 - 1, 1e-9);
  EXPECT_NEAR(score_of(far, Score::harmonic), std::log(3.0) - 1e5, 1e-9);
}

TEST(ScoreOf, WhatIsNotFiniteIsTheWorst) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const Score score : kScores)
      EXPECT_EQ(score_of(Vector{{1, bad}}, score), -std::numeric_limits<double>::infinity());
}

TEST(ScoreGradient, AgreesWithFiniteDifferences) {
  const Vector log_p{{-1.5, 0.3, 2}};
  for (const Score score : kScores) {
    const Vector gradient = score_gradient(log_p, score);
    for (Index i = 0; i < 3; ++i) {
      const Vector step = 1e-5 * Vector::Unit(3, i);
      const double slope = (score_of(log_p + step, score) - score_of(log_p - step, score)) / 2e-5;
      EXPECT_NEAR(gradient(i), slope, 1e-9) << static_cast<int>(score);
    }
  }
  EXPECT_NEAR((score_gradient(Vector{{1e5, -1e5}}, Score::sum) - Vector{{1, 0}}).norm(), 0, 1e-300);
}

}  // namespace
}  // namespace rehearse::identification
