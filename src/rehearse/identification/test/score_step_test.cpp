#include "rehearse/identification/score_step.hpp"

#include <gtest/gtest.h>

#include "scores.hpp"

namespace rehearse::identification {
namespace {

/// Two outputs that want different steps.
Quadratics two_outputs() {
  Quadratics q{Vector{{3, 2}}, Matrix(2, 2), {Matrix(2, 2), Matrix(2, 2)}};
  q.gradients << 1, -0.5, 0.5, 1;
  q.curvatures[0] << 2, 0.5, 0.5, 1;
  q.curvatures[1] << 1, -0.2, -0.2, 3;
  return q;
}

double penalised(const Quadratics& q, Score score, const Vector& d) { return score_of(q.at(d), score); }

// No point of a grid over the box has a higher score than the step by more than what the grid's spacing explains.
TEST(BestStep, IsTheBestOfTheBox) {
  const Quadratics q = two_outputs();
  for (const Score score : kScores) {
    for (const double reach : {0.05, 0.4, 3.0}) {
      const Vector low = Vector::Constant(2, -reach), high = Vector{{reach, reach / 2}};
      const Vector step = best_step(q, score, low, high, 0);
      EXPECT_TRUE((step.array() >= low.array()).all() && (step.array() <= high.array()).all());
      for (double a = 0; a <= 1; a += 0.05)
        for (double b = 0; b <= 1; b += 0.05) {
          const Vector other = low + Vector{{a, b}}.cwiseProduct(high - low);
          EXPECT_GE(penalised(q, score, step), penalised(q, score, other) - 1e-4)
              << static_cast<int>(score) << " reach " << reach << " at " << other.transpose();
        }
    }
  }
}

TEST(BestStep, DampingShortensIt) {
  const Quadratics q = two_outputs();
  const Vector box = Vector::Constant(2, 10);
  for (const Score score : kScores) {
    double before = best_step(q, score, -box, box, 0).norm();
    for (const double damping : {0.3, 3.0, 300.0}) {
      const double length = best_step(q, score, -box, box, damping).norm();
      EXPECT_LT(length, before);
      before = length;
    }
    EXPECT_LT(before, 0.02);
  }
}

TEST(BestStep, AFlatDirectionIsLeftAlone) {
  Quadratics q{Vector{{0}}, Matrix::Zero(2, 1), {Matrix::Zero(2, 2)}};
  const Vector box = Vector::Ones(2);
  EXPECT_EQ(best_step(q, Score::product, -box, box, 1e-6), Vector::Zero(2)) << "flat in every direction";
  q.gradients(0) = 1, q.curvatures[0](0, 0) = 4;
  const Vector step = best_step(q, Score::product, -box, box, 0);
  EXPECT_NEAR(step(0), 0.25, 1e-6);
  EXPECT_EQ(step(1), 0);
}

}  // namespace
}  // namespace rehearse::identification
