#include "rehearse/core/angle.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse {
namespace {

constexpr double kPi = std::numbers::pi;

/// The library's functions reduce exactly; a reduced angle must have the same sine and cosine.
void expect_reduced(double x) {
  const double angle = reduced_angle(x);
  ASSERT_LE(std::abs(angle), kPi) << x;
  const double s = std::sin(x), c = std::cos(x);
  ASSERT_NEAR(std::sin(angle), s, 7e-16 * std::min(1.0, std::abs(angle)) + 1e-300) << x;
  ASSERT_NEAR(std::cos(angle), c, 7e-16) << x;
}

TEST(Angle, IsReducedExactlyWhateverItsSize) {
  Rng rng({.seed = 1, .purpose = Purpose::test});
  for (int exponent = -1074; exponent < 1024; ++exponent)
    for (int i = 0; i < 20; ++i) expect_reduced(std::ldexp(rng.uniform(-1, 1), exponent));
  for (const double x : {0.0, -0.0, 1e-300, kPi, 2 * kPi, std::numeric_limits<double>::max()}) expect_reduced(x);
}

TEST(Angle, NearMultiplesOfPiNoDigitIsLost) {
  // the double nearest to a multiple of π/2 of all (Muller 2006, table 11.1), and doubles nearest to turns
  const double nearest = 6381956970095103.0 * std::ldexp(1.0, 797);
  EXPECT_NEAR(std::cos(reduced_angle(nearest)), std::cos(nearest), 3e-16);
  for (std::uint64_t k = 1; k < 1'000'000'000'000; k = 3 * k + 1) {
    const double x = 2 * kPi * static_cast<double>(k), s = std::sin(x);
    EXPECT_NEAR(reduced_angle(x), std::asin(s), 7e-16 * std::abs(s)) << k;
    EXPECT_EQ(reduced_angle(-x), -reduced_angle(x));
  }
}

TEST(Angle, WhatIsNotFiniteIsNan) {
  for (const double x : {kInf, -kInf, std::nan("")}) EXPECT_TRUE(std::isnan(reduced_angle(x)));
}

TEST(Angle, OnlyFarOnesAreChanged) {
  double x[] = {1, -38999, 39000, 1e9, -kInf};
  reduce_far_angles(x, 5);
  EXPECT_EQ(x[0], 1);
  EXPECT_EQ(x[1], -38999);
  EXPECT_EQ(x[2], reduced_angle(39000));
  EXPECT_EQ(x[3], reduced_angle(1e9));
  EXPECT_TRUE(std::isnan(x[4]));
}

}  // namespace
}  // namespace rehearse
