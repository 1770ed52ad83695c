#include "rehearse/study/bands.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::study {
namespace {

/// Predictions of 0 with deviation 1 of numbers from −10 to 10.
Forecasts from_zero() {
  Forecasts forecasts{{}, {1}, {{Matrix::Zero(201, 1), Matrix::Ones(201, 1), Matrix(201, 1)}}};
  for (Index i = 0; i < 201; ++i)
    forecasts.starts.push_back(i), forecasts.at[0].measured(i, 0) = 0.1 * static_cast<double>(i - 100);
  return forecasts;
}

TEST(Bands, AreCalibratedToHoldNineteenOfTwenty) {
  const std::vector<Forecasts> all = {from_zero()};
  const Matrix factors = calibration(all);
  EXPECT_NEAR(factors(0, 0), std::sqrt(2.0) * 9.5 / 1.96, 0.05);  // for another log than the one
  const Accuracy after = accuracy(all, factors / std::sqrt(2.0));
  EXPECT_NEAR(after.covered(0, 0), 0.95, 0.006);
  EXPECT_NEAR(after.rms(0, 0), 10 / std::sqrt(3.0), 0.1);
  EXPECT_EQ(after.compared(0, 0), 201);
}

TEST(Bands, WhatCannotBeComparedIsLeftOut) {
  std::vector<Forecasts> all = {from_zero()};
  all[0].at[0].predicted(3, 0) = std::nan("");
  all[0].at[0].measured(4, 0) = std::nan("");
  EXPECT_EQ(accuracy(all, calibration(all)).compared(0, 0), 199);
  widen(all, Matrix::Constant(1, 1, std::sqrt(3.0)));
  EXPECT_DOUBLE_EQ(all[0].at[0].deviation(0, 0), 2);
}

TEST(Bands, EachStateCountsItsOwn) {
  std::vector<Forecasts> all = {from_zero()};
  for (Matrix* numbers : {&all[0].at[0].predicted, &all[0].at[0].deviation, &all[0].at[0].measured})
    *numbers = numbers->replicate(1, 2).eval();
  all[0].at[0].predicted(3, 1) = std::nan("");
  const Accuracy found = accuracy(all, calibration(all));
  EXPECT_EQ(found.compared(0, 0), 201);
  EXPECT_EQ(found.compared(0, 1), 200);
}

}  // namespace
}  // namespace rehearse::study
