#include "rehearse/optim/least_squares.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/optim/box_quadratic.hpp"

namespace rehearse::optim {
namespace {

/// Derivatives by central differences.
Matrix differences(const std::function<Vector(const Vector&)>& errors, const Vector& x) {
  Matrix J(errors(x).size(), x.size());
  for (Index i = 0; i < x.size(); ++i) {
    const Vector d = 1e-5 * Vector::Unit(x.size(), i);
    J.col(i) = (errors(x + d) - errors(x - d)) / 2e-5;
  }
  return J;
}

SquaresProblem problem(std::function<Vector(const Vector&)> errors, Index n, double bound) {
  return {errors, [errors](const Vector& x, const Vector&) { return differences(errors, x); },
          Vector::Constant(n, -bound), Vector::Constant(n, bound)};
}

Vector rosenbrock_residuals(const Vector& x) { return Vector{{10 * (x(1) - x(0) * x(0)), 1 - x(0)}}; }

TEST(MinimiseSquares, FollowsACurvedValleyToItsEnd) {
  const SquaresResult found = minimise_squares(problem(rosenbrock_residuals, 2, 5), Vector{{-1.2, 1}});
  EXPECT_LT((found.x - Vector::Ones(2)).norm(), 1e-9);
  EXPECT_LT(found.evaluations, 60);
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.value, rosenbrock_residuals(found.x).squaredNorm());
}

TEST(MinimiseSquares, LeavesResidualsThatNoPointExplains) {
  const auto line = [](const Vector& x) { return Vector{{x(0) - 1, x(0) - 2, x(0) - 6}}; };
  const SquaresResult found = minimise_squares(problem(line, 1, 9), Vector{{-4}});
  EXPECT_NEAR(found.x(0), 3, 1e-6);
  EXPECT_NEAR(found.value, 14, 1e-9);
  EXPECT_TRUE(found.converged);
}

// On the edge x0 = 0.5 the best x1 is x0² = 0.25.
TEST(MinimiseSquares, EndsAtTheBorderWhereTheMinimumIsBeyond) {
  SquaresProblem bounded = problem(rosenbrock_residuals, 2, 5);
  bounded.high(0) = 0.5;
  const SquaresResult found = minimise_squares(bounded, Vector{{-1.2, 1}});
  EXPECT_EQ(found.x(0), 0.5);
  EXPECT_NEAR(found.x(1), 0.25, 1e-6);
}

TEST(MinimiseSquares, WhatChangesNothingStays) {
  const auto product = [](const Vector& x) { return Vector{{x(0) * x(1) - 2, 3 * (x(0) * x(1) - 2)}}; };
  SquaresProblem with_idle = problem(product, 3, 5);
  const SquaresResult found = minimise_squares(with_idle, Vector{{1, 1, 0.3}});
  EXPECT_NEAR(found.x(0) * found.x(1), 2, 1e-9);
  EXPECT_NEAR(found.x(0), found.x(1), 1e-3) << "the shortest way onto the ridge";
  EXPECT_EQ(found.x(2), 0.3);
  with_idle.low(0) = with_idle.high(0) = 4;
  EXPECT_NEAR(minimise_squares(with_idle, Vector{{4, 1, 0.3}}).x(1), 0.5, 1e-9) << "where the box has no width";
}

TEST(MinimiseSquares, StepsToWhereThereIsNoValueAreNotMade) {
  const auto root = [](const Vector& x) { return Vector{{std::sqrt(x(0)) - 0.1}}; };
  SquaresProblem half = problem(root, 1, 5);
  half.derivatives = [](const Vector& x, const Vector&) { return Matrix::Constant(1, 1, 0.5 / std::sqrt(x(0))); };
  EXPECT_NEAR(minimise_squares(half, Vector{{4}}).x(0), 0.01, 1e-9);
  const SquaresResult none = minimise_squares(half, Vector{{-1}});
  EXPECT_EQ(none.x(0), -1);
  EXPECT_EQ(none.value, kInf);
  EXPECT_FALSE(none.converged);
}

TEST(MinimiseSquares, SaysWhereDerivativesMislead) {
  SquaresProblem wrong = problem(rosenbrock_residuals, 2, 5);
  wrong.derivatives = [](const Vector& x, const Vector&) { return Matrix(-differences(rosenbrock_residuals, x)); };
  const SquaresResult found = minimise_squares(wrong, Vector{{-1.2, 1}});
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.x, (Vector{{-1.2, 1}}));
}

TEST(MinimiseSquares, RefusesAStartOutsideTheBox) {
  EXPECT_THROW(minimise_squares(problem(rosenbrock_residuals, 2, 1), Vector{{0, 2}}), InvalidInput);
  EXPECT_THROW(minimise_squares(problem(rosenbrock_residuals, 2, 1), Vector{{0}}), InvalidInput);
}

/// Random linear problems whose minimum is mostly on the border, against the quadratic's own minimiser.
TEST(MinimiseSquares, FindsTheMinimumOfLinearProblemsInABox) {
  Rng rng({.purpose = Purpose::test});
  for (int k = 0; k < 300; ++k) {
    const Index n = 2 + k % 5;
    Matrix A(2 * n, n);
    Vector b(2 * n), first(n);
    for (double& a : A.reshaped()) a = rng.uniform(-2, 2);
    for (double& each : b) each = rng.uniform(-4, 4);
    for (double& each : first) each = k % 3 == 0 ? -1 : rng.uniform(-1, 1);
    const SquaresProblem linear{[&](const Vector& x) -> Vector { return A * x + b; },
                                [&](const Vector&, const Vector&) { return A; }, Vector::Constant(n, -1),
                                Vector::Constant(n, 1)};
    const SquaresResult found = minimise_squares(linear, first);
    const auto best = minimise_in_box(A.transpose() * A, A.transpose() * b, linear.low, linear.high, first);
    ASSERT_TRUE(best);
    EXPECT_TRUE(found.converged);
    EXPECT_LT(found.value, (A * best->x + b).squaredNorm() * (1 + 1e-9)) << "problem " << k;
  }
}

TEST(MinimiseSquares, LetsACoordinateLeaveItsBound) {
  const Matrix A{{1, -2}, {0, -2}};
  const SquaresProblem corner{[&](const Vector& x) -> Vector {
                                return A * x + Vector{{3, -1}};
                              },
                              [&](const Vector&, const Vector&) { return A; }, Vector::Zero(2), Vector::Ones(2)};
  const SquaresResult found = minimise_squares(corner, Vector::Zero(2));
  EXPECT_LT((found.x - Vector{{0, 0.5}}).norm(), 1e-5) << found.x;
}

}  // namespace
}  // namespace rehearse::optim
