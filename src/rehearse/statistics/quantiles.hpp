#pragma once

#include <vector>

namespace rehearse::statistics {

/// The value below which a fraction of the values lies, interpolated linearly between the two nearest (Hyndman and Fan
/// 1996, type 7). fraction: 0..1. NaN if there are no values; infinite ones are allowed.
double quantile(std::vector<double> values, double fraction);

double median(std::vector<double> values);
double mean(const std::vector<double>& values);

struct FiveNumbers {
  double min = 0, quartile_1 = 0, median = 0, quartile_3 = 0, max = 0;
};

/// NaN if there are no values.
FiveNumbers five_numbers(std::vector<double> values);

}  // namespace rehearse::statistics
