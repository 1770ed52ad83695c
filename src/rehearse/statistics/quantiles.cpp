#include "rehearse/statistics/quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rehearse/core/types.hpp"

namespace rehearse::statistics {
namespace {

double of_sorted(const std::vector<double>& sorted, double fraction) {
  if (sorted.empty()) return kNaN;
  const double position = fraction * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const double rest = position - static_cast<double>(below);
  if (rest == 0) return sorted[below];  // beside an infinite value, too
  return std::lerp(sorted[below], sorted[below + 1], rest);
}

}  // namespace

double quantile(std::vector<double> values, double fraction) {
  std::sort(values.begin(), values.end());
  return of_sorted(values, fraction);
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

FiveNumbers five_numbers(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {of_sorted(values, 0), of_sorted(values, 0.25), of_sorted(values, 0.5), of_sorted(values, 0.75),
          of_sorted(values, 1)};
}

}  // namespace rehearse::statistics
