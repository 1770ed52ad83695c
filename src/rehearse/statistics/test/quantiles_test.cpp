#include "rehearse/statistics/quantiles.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace rehearse::statistics {
namespace {

TEST(Quantiles, InterpolateLinearly) {
  // numpy.quantile([3, 1, 4, 1, 5, 9, 2, 6], [0.25, 0.5, 0.75]) = 1.75, 3.5, 5.25
  const FiveNumbers five = five_numbers({3, 1, 4, 1, 5, 9, 2, 6});
  EXPECT_EQ(five.min, 1);
  EXPECT_DOUBLE_EQ(five.quartile_1, 1.75);
  EXPECT_DOUBLE_EQ(five.median, 3.5);
  EXPECT_DOUBLE_EQ(five.quartile_3, 5.25);
  EXPECT_EQ(five.max, 9);
  EXPECT_DOUBLE_EQ(quantile({10, 20}, 0.1), 11);
}

TEST(Quantiles, OfOneValueAndOfNone) {
  EXPECT_EQ(five_numbers({7}).quartile_1, 7);
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_TRUE(std::isnan(five_numbers({}).max));
}

TEST(Quantiles, InfiniteValuesSpoilOnlyWhatTheyTouch) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(median({1, 2, infinity}), 2);
  EXPECT_EQ(median({1, infinity, infinity}), infinity);
}

}  // namespace
}  // namespace rehearse::statistics
