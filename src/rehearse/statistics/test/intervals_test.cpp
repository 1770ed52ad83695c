#include "rehearse/statistics/intervals.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse::statistics {
namespace {

/// P(Binomial(n, p) ≥ k), term by term.
double at_least(int k, int n, double p) {
  double sum = 0;
  for (int i = k; i <= n; ++i) {
    double term = 1;
    for (int j = 0; j < i; ++j) term *= p * (n - j) / (i - j);
    sum += term * std::pow(1 - p, n - i);
  }
  return sum;
}

TEST(RateInterval, LeavesTwoAndAHalfPercentOnEachSide) {
  for (int n : {1, 3, 10, 30, 120})
    for (int k = 0; k <= n; k += 1 + n / 10) {
      const Interval interval = rate_interval(k, n);
      EXPECT_NEAR(at_least(k, n, interval.low), k > 0 ? 0.025 : 1, 1e-9) << k << " of " << n;
      EXPECT_NEAR(1 - at_least(k + 1, n, interval.high), k < n ? 0.025 : 1, 1e-9) << k << " of " << n;
    }
}

TEST(RateInterval, KnownValues) {
  EXPECT_NEAR(rate_interval(5, 10).low, 0.1871, 5e-5);  // Newcombe 1998 and every textbook
  EXPECT_NEAR(rate_interval(5, 10).high, 0.8129, 5e-5);
  EXPECT_NEAR(rate_interval(30, 30).low, std::pow(0.025, 1.0 / 30), 1e-12);
  EXPECT_EQ(rate_interval(30, 30).high, 1);
  EXPECT_EQ(rate_interval(0, 3).low, 0);
  EXPECT_EQ(rate_interval(0, 0).low, 0);
  EXPECT_EQ(rate_interval(0, 0).high, 1);
}

TEST(RunsToExclude, AreTheLeastWhoseIntervalEndsBelow) {
  for (const double rate : {0.5, 0.05, 0.003}) {
    const Index runs = runs_to_exclude(rate);
    EXPECT_LE(rate_interval(0, runs).high, rate);
    EXPECT_GT(rate_interval(0, runs - 1).high, rate);
  }
}

TEST(MedianInterval, IsAPairOfOrderStatistics) {
  std::vector<double> values;
  for (int i = 1; i <= 30; ++i) values.push_back((7 * i) % 31);  // 1..30, mixed
  EXPECT_EQ(median_interval(values).low, 10);                    // 10th and 21st of 30: any table of the sign test
  EXPECT_EQ(median_interval(values).high, 21);
  EXPECT_EQ(median_interval({4, 1, 3, 6, 2, 5}).low, 1);
  EXPECT_EQ(median_interval({4, 1, 3, 6, 2, 5}).high, 6);
  EXPECT_TRUE(std::isinf(median_interval({1, 2, 3, 4, 5}).low));
  EXPECT_TRUE(std::isinf(median_interval({}).high));
}

TEST(MedianInterval, OfManyValuesDoesNotUnderflow) {
  std::vector<double> values;
  for (int i = 0; i < 10000; ++i) values.push_back(i);
  EXPECT_NEAR(median_interval(values).low, 5000 - 98, 2);  // 1.96 × ½√n
}

/// The number of the 2^n sign flips of (values − centre) whose sum is at least as large as the sum itself.
int flips_as_large(const std::vector<double>& values, double centre) {
  int count = 0;
  for (unsigned flips = 0; flips < 1u << values.size(); ++flips) {
    double lost = 0;  // what the flips take from the sum, halved
    for (std::size_t i = 0; i < values.size(); ++i) lost += (flips >> i & 1) ? values[i] - centre : 0;
    count += lost <= 1e-12;
  }
  return count;
}

TEST(MeanInterval, IsWhatTheSignFlipTestDoesNotReject) {
  const std::vector<double> values = {2.1, -0.4, 3.3, 0.9, 1.7, -1.2, 4.0, 0.3, 2.6};
  const Interval interval = mean_interval(values);
  const double flips = 512, nudge = 1e-6;
  EXPECT_GT(flips_as_large(values, interval.low + nudge) / flips, 0.025);
  EXPECT_LE(flips_as_large(values, interval.low - nudge) / flips, 0.025);
  std::vector<double> mirrored;
  for (double value : values) mirrored.push_back(-value);
  EXPECT_NEAR(mean_interval(mirrored).high, -interval.low, 1e-12);
  EXPECT_NEAR(mean_interval(mirrored).low, -interval.high, 1e-12);
}

TEST(MeanInterval, NeedsSixValues) {
  EXPECT_TRUE(std::isinf(mean_interval({1, 1, 1, 1, 1}).low));
  EXPECT_EQ(mean_interval({6, 1, 5, 2, 4, 3}).low, 1);
  EXPECT_EQ(mean_interval({6, 1, 5, 2, 4, 3}).high, 6);
  EXPECT_TRUE(std::isinf(mean_interval({}).high));
}

TEST(MeanInterval, OfEqualValuesIsAPoint) {
  EXPECT_EQ(mean_interval(std::vector<double>(30, 2.0)).low, 2);
  EXPECT_EQ(mean_interval(std::vector<double>(8, 0.0)).high, 0);
}

// 500 samples of 20 symmetric, heavy-tailed values, seed 1: covered Binomial(500, 0.95), within 4 standard deviations
// but for one chance in 16 000.
TEST(MeanInterval, CoversTheCentreAsOftenAsItSays) {
  Rng rng({.seed = 1});
  int covered = 0;
  for (int sample = 0; sample < 500; ++sample) {
    std::vector<double> values(20);
    for (double& value : values) value = 3 + rng.normal() / (0.1 + rng.uniform());
    const Interval interval = mean_interval(values);
    covered += interval.low <= 3 && 3 <= interval.high;
  }
  EXPECT_NEAR(covered, 475, 19);
}

TEST(Rate, IsACountWithItsInterval) {
  const Rate three = rate(3, 12);
  EXPECT_EQ(three.value(), 0.25);
  EXPECT_EQ(three.interval.low, rate_interval(3, 12).low);
  EXPECT_TRUE(std::isnan(rate(0, 0).value()));
}

}  // namespace
}  // namespace rehearse::statistics
