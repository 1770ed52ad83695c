#include "rehearse/policy/squash.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::policy {
namespace {

TEST(Squash, IsCentrePlusHalfWidthTimesTanh) {
  const Squash squash{{{-2, 4}, {-1, 1}}, 3};
  Matrix a{{0.1, -0.2}, {0, 0}, {5, -5}};
  const Matrix before = a;
  squash.apply(a);
  for (Index i = 0; i < 3; ++i) {
    EXPECT_NEAR(a(i, 0), 1 + 3 * std::tanh(3 * before(i, 0)), 1e-14);
    EXPECT_NEAR(a(i, 1), std::tanh(3 * before(i, 1)), 1e-14);
  }
}

TEST(Squash, AsASineIsThatOfPilco) {
  const Squash squash{{{-2, 4}, {-1, 1}}, 3, Squash::Shape::sine};
  Matrix a{{0.1, -0.2}, {0, 0}, {0.5, -5}};
  const Matrix before = 3 * a;
  squash.apply(a);
  const auto sine = [](double x) { return (9 * std::sin(x) + std::sin(3 * x)) / 8; };
  for (Index i = 0; i < 3; ++i) {
    EXPECT_NEAR(a(i, 0), 1 + 3 * sine(before(i, 0)), 1e-14);
    EXPECT_NEAR(a(i, 1), sine(before(i, 1)), 1e-14);
  }
}

TEST(Squash, InfinitiesEndAtTheBoundsAndNanStays) {
  Matrix a{{kInf}, {-kInf}, {1e300}, {kNaN}};
  Squash{{{-2, 4}}, 1}.apply(a);
  EXPECT_EQ(a(0, 0), 4);
  EXPECT_EQ(a(1, 0), -2);
  EXPECT_EQ(a(2, 0), 4);
  EXPECT_TRUE(std::isnan(a(3, 0)));
  a = Matrix{{kInf}, {-kInf}, {1e300}, {kNaN}};
  Squash{{{-2, 4}}, 1, Squash::Shape::sine}.apply(a);
  for (Index i = 0; i < 3; ++i) EXPECT_TRUE(-2 <= a(i, 0) && a(i, 0) <= 4) << a(i, 0);
  EXPECT_TRUE(std::isnan(a(3, 0)));
}

}  // namespace
}  // namespace rehearse::policy
