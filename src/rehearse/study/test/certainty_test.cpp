#include "rehearse/study/certainty.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/parameters.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/identification/phi_posterior.hpp"

namespace rehearse::study {
namespace {

/// Errors in blocks of ten; `alike`: those of a block are the same.
FittedSquares fitted_line(bool alike) {
  Rng rng({.seed = 4});
  FittedSquares fitted{Vector(1000), Matrix(1000, 1), {}};
  for (Index i = 0; i < 1000; ++i) {
    fitted.errors(i) = alike && i % 10 > 0 ? fitted.errors(i - 1) : rng.normal();
    fitted.derivatives(i, 0) = 1;
    fitted.blocks.push_back(i / 10);
  }
  return fitted;
}

TEST(Certainty, ErrorsThatAreAlikeTellLess) {
  EXPECT_NEAR(inflation(fitted_line(false)), 4, 1.6);  // four times what independent errors make, of 100 blocks
  EXPECT_NEAR(inflation(fitted_line(true)), 40, 16);
  EXPECT_GT(covariance(fitted_line(true))(0, 0), 4 * covariance(fitted_line(false))(0, 0));
}

TEST(Certainty, WhatIsNotToldIsAnywhereInItsBox) {
  FittedSquares fitted = fitted_line(false);
  fitted.derivatives.conservativeResize(1000, 2);
  fitted.derivatives.col(1).setZero();
  const ParameterSpace space({Parameter::continuous("a", 1, {0, 2}), Parameter::continuous("b", 5, {0, 10})});
  const auto posterior = identification::posterior_of(covariance(fitted), space, Vector{{1, 5}});
  ASSERT_TRUE(posterior);
  EXPECT_NEAR(posterior->covariance(1, 1), 100.0 / 12, 1e-6);
  EXPECT_FALSE(identification::posterior_of(covariance(fitted), space.fixed_at(Vector{{1, 5}}), Vector{{1, 5}}));
}

TEST(Certainty, ErrorsThatTellNothingLeaveTheBoxes) {
  FittedSquares fitted = fitted_line(false);
  fitted.derivatives.setZero();
  EXPECT_NEAR(inflation(fitted), 4 * fitted.errors.squaredNorm() / 1000, 1e-12);
  const ParameterSpace space({Parameter::continuous("a", 1, {0, 2})});
  const auto posterior = identification::posterior_of(covariance(fitted), space, Vector{{1}});
  ASSERT_TRUE(posterior);
  EXPECT_NEAR(posterior->covariance(0, 0), 4.0 / 12, 1e-9);
}

}  // namespace
}  // namespace rehearse::study
