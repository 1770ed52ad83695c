#include "rehearse/statistics/columns.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::statistics {
namespace {

TEST(Columns, StatisticsAreThoseOfFiniteValues) {
  Matrix columns(5, 2);
  columns.col(0) << 4, NAN, 1, 2, 3;
  columns.col(1) << NAN, INFINITY, NAN, -INFINITY, NAN;
  EXPECT_EQ(column_quantiles(columns, 0.5)(0), 2.5);
  EXPECT_EQ(column_quantiles(columns, 0)(0), 1);
  EXPECT_EQ(column_quantiles(columns, 1)(0), 4);
  EXPECT_EQ(column_means(columns)(0), 2.5);
  EXPECT_NEAR(column_deviations(columns)(0), std::sqrt(5.0 / 3), 1e-15);
  EXPECT_DOUBLE_EQ(column_root_mean_squares(columns)(0), std::sqrt(30.0 / 4));
  EXPECT_TRUE(std::isnan(column_quantiles(columns, 0.5)(1)) && std::isnan(column_means(columns)(1)));
  EXPECT_TRUE(std::isnan(column_deviations(columns)(1)) && std::isnan(column_root_mean_squares(columns)(1)));
}

TEST(Columns, RootMeanSquaresAreThoseOfFiniteNumbers) {
  const Vector found = column_root_mean_squares(Matrix{{3, 1, NAN}, {-3, NAN, INFINITY}, {3, INFINITY, NAN}});
  EXPECT_DOUBLE_EQ(found(0), 3);
  EXPECT_DOUBLE_EQ(found(1), 1);
  EXPECT_TRUE(std::isnan(found(2)));
}

TEST(Columns, OfOneValueThereIsNoDeviation) { EXPECT_TRUE(std::isnan(column_deviations(Matrix::Ones(1, 1))(0))); }

TEST(Columns, TheMeanOfEqualValuesIsThatValue) {
  EXPECT_EQ(column_means(Matrix::Constant(10, 1, 0.1))(0), 0.1);
  EXPECT_EQ(column_deviations(Matrix::Constant(10, 1, 0.1))(0), 0);
}

}  // namespace
}  // namespace rehearse::statistics
