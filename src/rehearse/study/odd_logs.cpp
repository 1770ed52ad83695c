#include "rehearse/study/odd_logs.hpp"

#include <algorithm>
#include <cmath>

namespace rehearse::study {

double unexplained(const Forecasts& forecasts, const Matrix& measured) {
  double sum = 0, n = 0;
  for (std::size_t h = 0; h < forecasts.horizons.size(); ++h) {
    const Forecasts::At& at = forecasts.at[h];
    for (Index s = 0; s < measured.cols(); ++s) {
      double errors = 0, changes = 0;
      for (std::size_t i = 0; i < forecasts.starts.size(); ++i) {
        const auto row = static_cast<Index>(i);
        const double error = at.predicted(row, s) - at.measured(row, s);
        const double change = at.measured(row, s) - measured(forecasts.starts[i], s);
        if (std::isfinite(error)) errors += error * error, changes += change * change;
      }
      if (errors > 0 && changes > 0) sum += 0.5 * std::log(errors / changes), n += 1;
    }
  }
  return std::exp(sum / n);
}

std::optional<std::size_t> odd_log(const std::vector<double>& unexplained) {
  constexpr double kMuch = 1.0 / 3, kTimes = 3;
  if (unexplained.size() < 3) return std::nullopt;
  const auto odd = std::ranges::max_element(unexplained);
  for (auto other = unexplained.begin(); other != unexplained.end(); ++other)
    if (other != odd && !(*odd >= std::max(kMuch, kTimes * *other))) return std::nullopt;
  return odd - unexplained.begin();
}

}  // namespace rehearse::study
