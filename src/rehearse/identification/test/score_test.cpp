#include "rehearse/identification/score.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/testing/check_gradient.hpp"
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
  for (const double bad : {kNaN, kInf})
    for (const Score score : kScores) EXPECT_EQ(score_of(Vector{{1, bad}}, score), -kInf);
}

TEST(ScoreGradient, AgreesWithFiniteDifferences) {
  const Vector log_p{{-1.5, 0.3, 2}};
  for (const Score score : kScores) {
    const auto value = [score](const Vector& at, Vector& gradient) {
      gradient = score_gradient(at, score);
      return score_of(at, score);
    };
    EXPECT_EQ(testing::check_gradient(value, log_p, 1e-9), std::vector<std::string>{}) << static_cast<int>(score);
  }
  EXPECT_NEAR((score_gradient(Vector{{1e5, -1e5}}, Score::sum) - Vector{{1, 0}}).norm(), 0, 1e-300);
}

}  // namespace
}  // namespace rehearse::identification
