#include "rehearse/identification/reach.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::identification {
namespace {

/// A problem in the unit box, with derivatives by differences.
optim::SquaresProblem problem(std::function<Vector(const Vector&)> errors, Index q) {
  const auto derivatives = [errors](const Vector& x, const Vector& r) {
    Matrix J(r.size(), x.size());
    for (Index i = 0; i < x.size(); ++i) J.col(i) = (errors(x + 1e-7 * Vector::Unit(x.size(), i)) - r) / 1e-7;
    return J;
  };
  return {errors, derivatives, Vector::Zero(q), Vector::Ones(q)};
}

// Known is a·b = 0.2 to a millionth, and c = 0.5: a and b reach from 0.2 to 1.
TEST(Reach, FollowsACurvedRidgeToTheEndsOfTheBox) {
  const auto errors = [](const Vector& z) { return Vector{{1e6 * (z(0) * z(1) - 0.2), 1e6 * (z(2) - 0.5)}}; };
  const Reach found = reach(problem(errors, 3), Vector{{0.5, 0.4, 0.5}}, {0, 1, 2}, 4);
  for (const std::size_t i : {0, 1}) {
    ASSERT_TRUE(found.ranges[i]);
    EXPECT_NEAR(found.ranges[i]->low, 0.2, 1e-3);
    EXPECT_EQ(found.ranges[i]->high, 1);
    EXPECT_LE(found.ranges[i]->low, 0.2);
  }
  EXPECT_FALSE(found.ranges[2]) << "c cannot move";
  EXPECT_GT(found.points.cols(), 20);
  for (const Vector& point : found.points.colwise()) EXPECT_NEAR(point(0) * point(1), 0.2, 2e-6);
}

TEST(Reach, EndsWhereTheSumRisesByTheTolerance) {
  const auto errors = [](const Vector& z) { return Vector{{10 * (z(0) - 0.5), 20 * (z(0) + z(1) - 1)}}; };
  const Reach found = reach(problem(errors, 2), Vector{{0.45, 0.5}}, {0}, 4);
  EXPECT_NEAR(found.ranges[0]->low, 0.3, 1e-3);
  EXPECT_NEAR(found.ranges[0]->high, 0.7, 1e-3);
  EXPECT_FALSE(found.ranges[1]) << "not asked for";
}

TEST(Reach, EndsWhereThereIsNoValue) {
  const auto errors = [](const Vector& z) { return Vector{{std::log(z(0) - 0.3) * 0, z(1) - 0.5}}; };
  const Reach found = reach(problem(errors, 2), Vector{{0.6, 0.5}}, {0}, 4);
  EXPECT_NEAR(found.ranges[0]->low, 0.3, 1e-3);
  EXPECT_EQ(found.ranges[0]->high, 1);
}

}  // namespace
}  // namespace rehearse::identification
