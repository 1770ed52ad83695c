#include "rehearse/identification/held_kernels.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/dynamics/test/swing.hpp"
#include "scores.hpp"

namespace rehearse::identification {
namespace {

/// GPs fitted to what the swing of wrong parameters leaves of 30 steps.
struct HeldKernelsTest : ::testing::Test {
  FitProblem problem(Score score) const { return {residuals, &prior, score, {}, serial_evaluator()}; }
  Fit fitted(const FitProblem& at, const Vector& phi) const {
    Fit fit = unfitted(phi, 2, {});
    at.refit(fit);
    return fit;
  }
  const Dataset data = swing::data(30, 1);
  const dynamics::Residuals residuals{data, swing::features()};
  prior::Prior prior = swing::prior({swing::length(), swing::friction()});
};

TEST_F(HeldKernelsTest, TheScoreAtTheStartIsThatOfTheFit) {
  for (const Score score : kScores) {
    const FitProblem at = problem(score);
    const Fit fit = fitted(at, Vector{{0.9, 0.2}});
    EXPECT_NEAR(held_score(at, fit), fit.score, 1e-8);
    const HeldKernels held(at, fit);
    EXPECT_LT((held.phi(held.start()) - fit.phi).norm(), 1e-14);
  }
}

TEST_F(HeldKernelsTest, QuadraticsAgreeWithFiniteDifferences) {
  const FitProblem at = problem(Score::product);
  const Fit fit = fitted(at, Vector{{0.9, 0.2}});
  const HeldKernels held(at, fit);
  const Vector z = held.start();
  const Quadratics q = held.quadratics(z, held.at(z));
  for (Index i = 0; i < 2; ++i) {
    const Vector step = 1e-4 * Vector::Unit(2, i);
    const Vector slopes = (held.at(z + step).log_evidences - held.at(z - step).log_evidences) / 2e-4;
    for (Index e = 0; e < 2; ++e)
      EXPECT_NEAR(q.gradients(i, e), slopes(e), 2e-3 * std::abs(slopes(e)) + 0.01) << i << " " << e;
  }
}

TEST_F(HeldKernelsTest, ClimbingFindsNoHigherScoreNearby) {
  for (const Score score : kScores) {
    const FitProblem at = problem(score);
    const Fit start = fitted(at, Vector{{0.9, 0.2}});
    Fit found = start;
    climb(at, found);
    EXPECT_GT(found.score, start.score + 1);
    Fit around = found;
    for (const double d : {-0.01, 0.01})
      for (const Index i : {0, 1}) {
        around.phi = found.phi + d * Vector::Unit(2, i);
        EXPECT_LT(held_score(at, around), found.score + 0.01);
      }
  }
}

// The length is rounded, so that the prior has no slope in it that differences could see: Subplex must.
TEST_F(HeldKernelsTest, ClimbsAPriorThatIsNotSmooth) {
  prior = swing::prior({swing::length(), swing::friction()},
                       [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
                         const Vector rounded{{std::round(phi(0) * 50) / 50, phi(1)}};
                         swing::ode(x, u, rounded, dxdt);
                       });
  const FitProblem at = problem(Score::product);
  Fit found = fitted(at, Vector{{0.85, 0.3}});
  const double before = found.score;
  climb(at, found);
  EXPECT_GT(found.score, before + 1);
  EXPECT_NEAR(found.phi(0), 0.8, 0.03);
}

TEST_F(HeldKernelsTest, KernelsThatWereNeverFittedHaveNoScore) {
  EXPECT_EQ(held_score(problem(Score::product), unfitted(Vector{{0.9, 0.2}}, 2, {})), -kInf);
}

TEST_F(HeldKernelsTest, AStepToWhereRowsFailIsNotMade) {
  prior = swing::prior({swing::length(), swing::friction()},
                       [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
                         swing::ode(x, u, phi, dxdt);
                         if (phi(0) < 0.85) dxdt(0) = kNaN;
                       });
  const FitProblem at = problem(Score::product);
  Fit found = fitted(at, Vector{{1.2, 0.2}});
  climb(at, found);
  EXPECT_GE(found.phi(0), 0.85);
  EXPECT_LT(found.phi(0), 1) << "as near to the truth, 0.8, as it gets";
}

}  // namespace
}  // namespace rehearse::identification
