#include "rehearse/reward/saturating.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::reward {
namespace {

void squares(const ConstMatrixView& X, VectorView d2) { d2 = X.col(0).cwiseAbs2(); }

Vector rewards_of(const Matrix& X_next, double width) {
  Vector rewards(X_next.rows());
  const Matrix U(X_next.rows(), 1);
  saturating(squares, width)(X_next, U, X_next, rewards);
  return rewards;
}

TEST(Saturating, IsOneAtTheGoalAndZeroFarAway) {
  const Vector r = rewards_of(Matrix{{0}, {0.5}, {-1}, {100}, {1e200}}, 0.5);
  EXPECT_EQ(r(0), 1);
  EXPECT_NEAR(r(1), std::exp(-0.5), 1e-15);
  EXPECT_NEAR(r(2), std::exp(-2), 1e-15);
  EXPECT_EQ(r(3), 0);
  EXPECT_EQ(r(4), 0) << "the square overflows";
}

TEST(Saturating, WidthScalesTheDistance) {
  EXPECT_NEAR(rewards_of(Matrix{{1}}, 0.25)(0), rewards_of(Matrix{{4}}, 1)(0), 1e-16);
}

TEST(Saturating, NanStaysInItsRow) {
  const Vector r = rewards_of(Matrix{{0}, {kNaN}, {0}}, 0.5);
  EXPECT_EQ(r(0), 1);
  EXPECT_TRUE(std::isnan(r(1)));
  EXPECT_EQ(r(2), 1);
}

}  // namespace
}  // namespace rehearse::reward
