#include "rehearse/optim/box.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::optim {
namespace {

const std::vector<Interval> intervals{{-1, 1}, {0, 10}};
const Vector values{{4, 3, 2, 1}};

TEST(Box, ProjectsAndLeavesTheInsideAlone) {
  Matrix X{{-3, 0.5}, {4, 12}};
  Box(intervals).project(X);
  EXPECT_EQ(X, (Matrix{{-1, 0.5}, {4, 10}}));
  Matrix Y{{-3}, {4}};
  Box().project(Y);
  EXPECT_EQ(Y, (Matrix{{-3}, {4}}));
}

TEST(Box, OnlyDrawsOutsideLoseAndTheFartherTheMore) {
  Box box(intervals);
  const Matrix X{{0, 1.5, 2, 0}, {5, 5, 5, -1}};
  const Vector loss = box.penalties(X, values, Vector{{0, 5}}, Vector{{1, 1}}, 2);
  EXPECT_EQ(loss(0), 0);
  EXPECT_GT(loss(1), 0);
  EXPECT_DOUBLE_EQ(loss(2), 4 * loss(1));
  EXPECT_DOUBLE_EQ(loss(3), loss(2));
}

TEST(Box, LossesScaleWithTheValues) {
  Box small(intervals), large(intervals);
  const Matrix X{{0, 1.5, 2, 0}, {5, 5, 5, -1}};
  const Vector mean{{0, 5}}, deviations{{1, 2}};
  const Vector a = small.penalties(X, values, mean, deviations, 2);
  const Vector b = large.penalties(X, 1000 * values, mean, deviations, 2);
  EXPECT_LT((b - 1000 * a).norm(), 1e-9);
}

TEST(Box, AMeanFarOutsideStrengthensItsWeight) {
  Box box(intervals);
  const Matrix X{{2, 2, 2, 2}, {5, 5, 5, 5}};
  const Vector mean{{6, 5}}, deviations{{1, 1}};
  const double first = box.penalties(X, values, mean, deviations, 2)(0);
  for (int g = 0; g < 50; ++g) box.penalties(X, values, mean, deviations, 2);
  EXPECT_GT(box.penalties(X, values, mean, deviations, 2)(0), 50 * first);
}

TEST(Box, APlateauOrNoFiniteValueCostsNothingAndSpoilsNothing) {
  Box box(intervals);
  const Matrix X{{0, 1.5, 2, 0}, {5, 5, 5, -1}};
  const Vector mean{{0, 5}}, deviations{{1, 1}};
  EXPECT_EQ(box.penalties(X, Vector::Constant(4, 3), mean, deviations, 2), Vector(Vector::Zero(4)));
  EXPECT_EQ(box.penalties(X, Vector::Constant(4, std::nan("")), mean, deviations, 2), Vector(Vector::Zero(4)));
  EXPECT_GT(box.penalties(X, values, mean, deviations, 2)(1), 0);
}

TEST(Box, RandomPointsFillTheMiddlePartAsked) {
  for (const double part : {1.0, 0.2}) {
    Vector low = Vector::Constant(2, 100), high = -low;
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Vector x = uniform_point(intervals, part, {.purpose = Purpose::search, .descent = i});
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    EXPECT_GE(low(0), -part);
    EXPECT_LT(low(0), -0.9 * part);
    EXPECT_LE(high(1), 5 + 5 * part);
    EXPECT_GT(high(1), 5 + 4.5 * part);
  }
}

}  // namespace
}  // namespace rehearse::optim
