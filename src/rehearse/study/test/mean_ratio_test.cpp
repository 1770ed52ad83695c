#include "rehearse/study/mean_ratio.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::study {
namespace {

TEST(MeanRatio, IsGeometric) { EXPECT_DOUBLE_EQ(mean_ratio(Matrix{{8, 1}}, Matrix{{2, 1}}), 2); }

TEST(MeanRatio, ComparesWhatCanBe) {
  EXPECT_DOUBLE_EQ(mean_ratio(Matrix{{6, 5, 0, 1}}, Matrix{{3, NAN, 1, 0}}), 2);
  EXPECT_DOUBLE_EQ(mean_ratio(Vector{{NAN}}, Vector{{3}}), std::exp(10.0)) << "a forecast failed";
  EXPECT_TRUE(std::isnan(mean_ratio(Vector{{1}}, Vector{{NAN}})));
}

}  // namespace
}  // namespace rehearse::study
