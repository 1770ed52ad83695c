#include "rehearse/statistics/columns.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::statistics {
namespace {

/// The mean, computed relative to the first value, so that the mean of equal values is that value.
double mean_beside_first(const std::vector<double>& values) {
  if (values.empty()) return kNaN;
  double sum = 0;
  for (double value : values) sum += value - values.front();
  return values.front() + sum / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  if (values.size() < 2) return kNaN;
  const double middle = mean_beside_first(values);
  double sum = 0;
  for (double value : values) sum += (value - middle) * (value - middle);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// statistic: of the finite values of a column, in their order.
template <class Statistic>
Vector of_columns(const Matrix& columns, Statistic statistic) {
  Vector found(columns.cols());
  std::vector<double> finite;
  for (Index c = 0; c < columns.cols(); ++c) {
    finite.clear();
    std::ranges::copy_if(columns.col(c), std::back_inserter(finite), [](double value) { return std::isfinite(value); });
    found(c) = statistic(finite);
  }
  return found;
}

}  // namespace

Vector column_means(const Matrix& columns) { return of_columns(columns, mean_beside_first); }
Vector column_deviations(const Matrix& columns) { return of_columns(columns, deviation); }
Vector column_quantiles(const Matrix& columns, double fraction) {
  return of_columns(columns, [&](const std::vector<double>& values) { return quantile(values, fraction); });
}
Vector column_root_mean_squares(const Matrix& columns) { return of_columns(columns, root_mean_square); }

}  // namespace rehearse::statistics
