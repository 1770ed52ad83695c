#include "rehearse/optim/strategy_constants.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::optim {
namespace {

TEST(StrategyConstants, TheDefaultPopulationGrowsWithTheLogarithm) {
  EXPECT_EQ(default_population(1), 4);
  EXPECT_EQ(default_population(10), 10);
  EXPECT_EQ(default_population(100), 17);
}

// Constants of ten dimensions and ten candidates, by the formulas of Hansen 2016 with another program.
TEST(StrategyConstants, AreThoseOfHansensTable) {
  const StrategyConstants c(10, 10, true);
  EXPECT_EQ(c.parents, 5);
  EXPECT_NEAR(c.mu_eff, 3.167299, 1e-6);
  EXPECT_NEAR(c.c_sigma, 0.284429, 1e-6);
  EXPECT_NEAR(c.d_sigma, 1.284429, 1e-6);
  EXPECT_NEAR(c.c_c, 0.294990, 1e-6);
  EXPECT_NEAR(c.c_1, 0.015284, 1e-6);
  EXPECT_NEAR(c.c_mu, 0.023552, 1e-6);
}

TEST(StrategyConstants, WeightsOfParentsSumToOneAndOthersCountIfActiveOnly) {
  for (const Index population : {4, 5, 10, 101}) {
    const StrategyConstants active(7, population, true), plain(7, population, false);
    EXPECT_EQ(active.weights.head(active.parents), plain.weights.head(plain.parents));
    EXPECT_NEAR(plain.weights.sum(), 1, 1e-14);
    EXPECT_GT(plain.weights.head(plain.parents).minCoeff(), 0);
    EXPECT_EQ(plain.weights.tail(population - plain.parents), Vector::Zero(population - plain.parents));
    for (Index i = 1; i < population; ++i) EXPECT_LE(active.weights(i), active.weights(i - 1)) << population;
  }
}

// Hansen 2016, eqs. 50, 52 and 53: the covariance neither decays nor loses its definiteness.
TEST(StrategyConstants, NegativeWeightsAreBounded) {
  const StrategyConstants few(10, 10, true), many(10, 100, true);
  EXPECT_NEAR(few.c_1 + few.c_mu * few.weights.sum(), 0, 1e-14);
  const double negative = -many.weights.cwiseMin(0).sum();
  EXPECT_NEAR(10 * many.c_mu * negative, 1 - many.c_1 - many.c_mu, 1e-12);
}

TEST(StrategyConstants, TheExpectedNormIsThatOfAGaussian) {
  for (const Index n : {1, 2, 10, 200}) {
    const double half = 0.5 * static_cast<double>(n);
    const double exact = std::sqrt(2.0) * std::exp(std::lgamma(half + 0.5) - std::lgamma(half));
    EXPECT_NEAR(StrategyConstants(n, 10, true).expected_norm, exact, 1e-3 * exact) << n;
  }
}

}  // namespace
}  // namespace rehearse::optim
