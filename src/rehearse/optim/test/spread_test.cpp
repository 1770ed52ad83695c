#include "rehearse/optim/spread.hpp"

#include <gtest/gtest.h>

namespace rehearse::optim {
namespace {

TEST(Spread, BeginsAtTheCentreAndStaysInTheCube) {
  for (const Index D : {1, 2, 7}) {
    EXPECT_EQ(spread_point(D, 0), Vector::Constant(D, 0.5));
    for (Index i = 1; i < 100; ++i) {
      const Vector point = spread_point(D, i);
      EXPECT_GE(point.minCoeff(), 0);
      EXPECT_LT(point.maxCoeff(), 1);
    }
  }
}

// Multiples of the golden ratio, and of the plastic number's powers.
TEST(Spread, IsTheRecurrenceOfRoberts) {
  EXPECT_NEAR(spread_point(1, 1)(0), 0.5 + 0.6180339887498949 - 1, 1e-12);
  EXPECT_NEAR(spread_point(2, 1)(0), 0.5 + 0.7548776662466927 - 1, 1e-12);
  EXPECT_NEAR(spread_point(2, 1)(1), 0.5 + 0.5698402909980532 - 1, 1e-12);
}

// Random points leave (1 − 1/64)^128 = 13 % of the cells empty.
TEST(Spread, FillsTheSquareMoreEvenlyThanChance) {
  constexpr Index kCells = 8;
  Matrix hits = Matrix::Zero(kCells, kCells);
  for (Index i = 0; i < 2 * kCells * kCells; ++i) {
    const Vector point = spread_point(2, i);
    ++hits(static_cast<Index>(kCells * point(0)), static_cast<Index>(kCells * point(1)));
  }
  EXPECT_LT((hits.array() == 0).count(), 4);
  EXPECT_LT(hits.maxCoeff(), 5);
}

}  // namespace
}  // namespace rehearse::optim
