#pragma once
// Two-sided 95 % intervals that hold for any number of values. An end that so few values cannot give is infinite (0 or
// 1 for a rate). Nothing here is random: the subsets that are drawn come from a stream of their own, always the same.

#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::statistics {

inline constexpr double kConfidence = 0.95;

/// The interval of the probability of success after `successes` of `runs` independent ones (Clopper and Pearson 1934).
/// runs ≥ 0, successes in 0..runs.
Interval rate_interval(Index successes, Index runs);

/// A count of independent runs as a rate with that interval.
struct Rate {
  Index count = 0, of = 0;
  Interval interval;

  double value() const { return static_cast<double>(count) / static_cast<double>(of); }  // NaN of no runs
};
Rate rate(Index count, Index of);

/// The least runs without a success after which the interval above ends at this probability, in (0, 1), or below.
Index runs_to_exclude(double probability);

/// The interval of the median of a distribution of which these are independent draws: order statistics (Thompson
/// 1936). Needs 6 values.
Interval median_interval(std::vector<double> values);

/// The interval of the centre of a symmetric distribution of which these are independent draws: the differences that
/// the sign-flip test of the mean does not reject, which are order statistics of the means of all non-empty subsets
/// (Hartigan 1969, theorem 1); above 14 values, of as many random ones as 14 have. Needs 6 values.
Interval mean_interval(const std::vector<double>& values);

}  // namespace rehearse::statistics
