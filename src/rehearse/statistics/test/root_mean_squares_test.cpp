#include "rehearse/statistics/root_mean_squares.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::statistics {
namespace {

TEST(RootMeanSquares, AreThoseOfFiniteNumbers) {
  const Vector found = root_mean_squares(Matrix{{3, 1, NAN}, {-3, NAN, INFINITY}, {3, INFINITY, NAN}});
  EXPECT_DOUBLE_EQ(found(0), 3);
  EXPECT_DOUBLE_EQ(found(1), 1);
  EXPECT_TRUE(std::isnan(found(2)));
}

}  // namespace
}  // namespace rehearse::statistics
