#include "rehearse/dynamics/integration.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse::dynamics {
namespace {

const Kinematics kKinematics{.dt_s = 0.1, .pairs = {{.position = 2, .rate = 0}}};

Matrix normals(std::uint64_t seed) {
  Rng rng({.seed = seed});
  return Matrix::NullaryExpr(6, 3, [&] { return rng.normal(); });
}

TEST(Integration, TheTrapezoidRuleLeavesNothingOfConstantAccelerations) {
  const Matrix X = normals(1);
  Matrix changes = normals(2);
  changes.col(2) = 0.1 * X.col(0) + 0.05 * changes.col(0);  // the position, of which the rate grows evenly
  const Matrix before = changes;
  subtract_integrals(kKinematics, X, false, changes);
  EXPECT_LT(changes.col(2).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(changes.leftCols(2), before.leftCols(2));
}

TEST(Integration, PositionsMoveHalfAStepWithTheRatesThatTheyHave) {
  const Kinematics chain{.dt_s = 0.1, .pairs = {{.position = 2, .rate = 0}, {.position = 0, .rate = 1}}};
  const Matrix X = normals(1);
  Matrix halfway = X;
  add_half_step(chain, X, halfway);
  EXPECT_EQ(halfway.col(0), X.col(0) + 0.05 * X.col(1));
  EXPECT_EQ(halfway.col(1), X.col(1));
  EXPECT_EQ(halfway.col(2), X.col(2) + 0.05 * X.col(0));
}

TEST(Integration, WhatIsSubtractedIsAddedAgain) {
  const Matrix X = normals(1), changes = normals(2);
  for (const bool has_prior : {false, true}) {
    Matrix targets = changes;
    subtract_integrals(kKinematics, X, has_prior, targets);
    EXPECT_GT((targets - changes).col(2).cwiseAbs().maxCoeff(), 0.01);
    add_integrals(kKinematics, X, has_prior, targets);
    EXPECT_LT((targets - changes).cwiseAbs().maxCoeff(), 1e-14) << has_prior;
  }
}

// A position (2), its rate (0), and the rate of that (1), in either order.
TEST(Integration, ChainsOfRatesAreAddedAgain) {
  using Pair = Kinematics::Pair;
  const Matrix X = normals(1), changes = normals(2);
  for (const auto& pairs : {std::vector<Pair>{{2, 0}, {0, 1}}, std::vector<Pair>{{0, 1}, {2, 0}}}) {
    const Kinematics chain{.dt_s = 0.1, .pairs = pairs};
    for (const bool has_prior : {false, true}) {
      Matrix targets = changes;
      subtract_integrals(chain, X, has_prior, targets);
      add_integrals(chain, X, has_prior, targets);
      EXPECT_LT((targets - changes).cwiseAbs().maxCoeff(), 1e-14) << has_prior;
    }
  }
}

TEST(Integration, AroundAPriorRatesCountByTheirResidualsAlone) {
  Matrix means = Matrix::Zero(6, 3);
  add_integrals(kKinematics, normals(1), true, means);
  EXPECT_EQ(means, Matrix::Zero(6, 3));
}

TEST(Integration, VariancesOfPositionsHaveAQuarterOfThatOfTheRates) {
  Matrix variance{{4, 1, 0.5}};
  add_variances_of_integrals(kKinematics, variance);
  EXPECT_TRUE(variance.isApprox(Matrix{{4, 1, 0.5 + 0.01}}));
}

TEST(Integration, VariancesOfChainsHaveThoseOfWholeRates) {
  const Kinematics chain{.dt_s = 0.1, .pairs = {{.position = 2, .rate = 0}, {.position = 0, .rate = 1}}};
  Matrix variance{{4, 1, 0.5}};
  add_variances_of_integrals(chain, variance);
  EXPECT_TRUE(variance.isApprox(Matrix{{4.0025, 1, 0.5 + 0.0025 * 4.0025}}, 1e-14)) << variance;
}

TEST(Integration, DerivativesAreThoseOfItsSums) {
  const Matrix X = normals(1), mean_slopes = normals(2), variance_slopes = normals(3).cwiseAbs();
  for (const bool has_prior : {false, true}) {
    Linearised at;
    at.resize(6, 3, 0);
    at.mean_by.setZero(), at.variance_by.setZero();
    at.mean_by.col(0) = mean_slopes.col(0);  // of the rate by the rate
    at.variance_by.col(1) = variance_slopes.col(1);
    add_integrals_of_derivatives(kKinematics, has_prior, at);
    EXPECT_EQ(at.mean_by.col(6), Vector(0.05 * mean_slopes.col(0).array() + (has_prior ? 0 : 0.1)));
    EXPECT_TRUE(at.variance_by.col(7).isApprox(0.0025 * variance_slopes.col(1)));
    EXPECT_EQ(at.mean_by.col(0), mean_slopes.col(0));
  }
}

}  // namespace
}  // namespace rehearse::dynamics
