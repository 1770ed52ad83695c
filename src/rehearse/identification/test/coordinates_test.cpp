#include "rehearse/identification/coordinates.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::identification {
namespace {

Matrix wave(const Vector& z) { return Matrix{{std::sin(3 * z(0)) * z(1), std::exp(z(1))}}; }

const auto kSlope0 = [](const Vector& z) { return Matrix{{3 * std::cos(3 * z(0)) * z(1), 0.0}}; };

TEST(Coordinates, AreFractionsOfTheBoxes) {
  const ParameterSpace space({Parameter::continuous("a", 2, {1, 5}), Parameter::fixed("b", 7)});
  const Coordinates coordinates(space, space.values());
  EXPECT_EQ(coordinates.start(), (Vector{{0.25}}));
  EXPECT_EQ(coordinates.phi(Vector{{0.5}}), (Vector{{3, 7}}));
  EXPECT_EQ(coordinates.low()(0) + coordinates.widths()(0), 5);
}

// 0.12 + (1.8 − 0.12) is rounded to more than 1.8.
TEST(Coordinates, EndAtTheBordersOfTheBox) {
  const ParameterSpace space({Parameter::continuous("m", 0.5, {0.12, 1.8})});
  const Coordinates coordinates(space, space.values());
  ASSERT_GT(coordinates.low()(0) + coordinates.widths()(0), 1.8);
  EXPECT_EQ(coordinates.phi(Vector{{0}})(0), 0.12);
  EXPECT_EQ(coordinates.phi(Vector{{1}})(0), 1.8);
}

TEST(PreciseSlopes, AreOfFourthOrderUpToTheBorder) {
  for (const double a : {0.0, 0.3, 1.0}) {
    const Vector z{{a, 0.6}};
    const Matrix exact = kSlope0(z);
    const PreciseSlopes precise = precise_slopes(wave, z, wave(z));
    EXPECT_LT((precise.values[0] - exact).norm(), 1e-9);
    EXPECT_LT(precise.errors[0].norm(), 1e-8);
    if (a > 0) {  // at 0 there is no curvature
      EXPECT_GT((slopes(wave, z, wave(z))[0] - exact).norm(), 1e-6) << "those of first order are worse";
    }
  }
}

TEST(PreciseSlopes, SayWhatTheyDoNotResolve) {
  const auto rounded = [](const Vector& z) { return Matrix((wave(z) * 1e6).array().round() / 1e6); };
  const Vector z{{0.3, 0.6}};
  const PreciseSlopes precise = precise_slopes(rounded, z, rounded(z));
  const double error = (precise.values[0] - kSlope0(z)).norm();
  EXPECT_GT(error, 1e-5);
  EXPECT_GT(2 * precise.errors[0].norm(), error);
}

TEST(PreciseSlopes, WherePointsFailAreThoseOfFirstOrder) {
  const auto fails = [](const Vector& z) { return z(0) > 0.3005 ? Matrix::Constant(1, 2, kNaN) : wave(z); };
  const Vector z{{0.3, 0.6}};
  EXPECT_EQ(precise_slopes(fails, z, wave(z)).values[0], slopes(fails, z, wave(z))[0]);
}

}  // namespace
}  // namespace rehearse::identification
