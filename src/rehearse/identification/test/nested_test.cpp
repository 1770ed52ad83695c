#include "rehearse/identification/nested.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/dynamics/test/swing.hpp"

namespace rehearse::identification {
namespace {

/// The swing of 25 steps, of which the prior does not know length and friction.
struct NestedTest : ::testing::Test {
  const Dataset data = swing::data(25, 1);
  const dynamics::Residuals residuals{data, swing::features()};
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const FitProblem problem{residuals, &prior, Score::product, {}, serial_evaluator()};
  double score_at(const Vector& phi, const Fit& near) const {
    Fit fit = near;
    fit.phi = phi;
    problem.refit(fit);
    return fit.score;
  }
};

TEST_F(NestedTest, FindsTheParametersFromTheGivenOnesOrFromThoseOfLeastSquares) {
  for (const bool least_squares : {false, true}) {
    GpMi kind;
    kind.least_squares_start = least_squares;
    const Fit found = search_nested(kind, problem, {});
    EXPECT_NEAR(found.phi(0), 0.8, 0.008) << least_squares;
    EXPECT_NEAR(found.phi(1), 0.3, 0.01) << least_squares;
    EXPECT_GT(found.evaluations, 10);
    EXPECT_GE(found.score, score_at(Vector{{0.9, 0.2}}, found)) << least_squares;
  }
}

TEST_F(NestedTest, IsNoWorseThanWhereItStarts) {
  GpMi kind;
  const Fit found = search_nested(kind, problem, {});
  kind.subplex.max_evaluations = 3;
  kind.least_squares_start = false;
  const Fit again = search_nested(kind, problem, {hyperparameters(found), found.phi});
  EXPECT_GE(again.score, found.score - 1e-6);
  EXPECT_LE(again.evaluations, 3);
}

// 0.12 + (1.8 − 0.12) is rounded to more than 1.8.
TEST(Nested, StartsAtTheBorderToWhichLeastSquaresLeads) {
  const Dataset data = swing::data(25, 1, Vector{{3, 0.3}});
  const dynamics::Residuals residuals(data, swing::features());
  const prior::Prior prior = swing::prior({Parameter::continuous("length", 0.5, {0.12, 1.8}), swing::friction()});
  GpMi kind;
  kind.subplex.max_evaluations = 10;
  const Fit found = search_nested(kind, {residuals, &prior, Score::product, {}, serial_evaluator()}, {});
  EXPECT_NEAR(found.phi(0), 1.8, 0.1);
  EXPECT_LE(found.phi(0), 1.8);
}

}  // namespace
}  // namespace rehearse::identification
