#include "rehearse/study/odd_logs.hpp"

#include <algorithm>
#include <cmath>

#include "rehearse/study/mean_ratio.hpp"

namespace rehearse::study {

double unexplained(const Forecasts& forecasts, const Matrix& measured) {
  const auto horizons = static_cast<Index>(forecasts.horizons.size());
  Matrix errors = Matrix::Zero(horizons, measured.cols()), changes = errors;
  for (Index h = 0; h < horizons; ++h) {
    const Forecasts::At& at = forecasts.at[static_cast<std::size_t>(h)];
    for (Index s = 0; s < measured.cols(); ++s)
      for (Index i = 0; i < at.predicted.rows(); ++i) {
        const double error = at.predicted(i, s) - at.measured(i, s);
        const double change = at.measured(i, s) - measured(forecasts.starts[static_cast<std::size_t>(i)], s);
        if (std::isfinite(error)) errors(h, s) += error * error, changes(h, s) += change * change;
      }
  }
  return mean_ratio(errors.cwiseSqrt(), changes.cwiseSqrt());
}

std::optional<std::size_t> odd_log(const std::vector<double>& unexplained) {
  constexpr double kMuch = 1.0 / 3, kTimes = 3;
  std::vector<double> known = unexplained;
  for (double& of : known)
    if (!std::isfinite(of)) of = -1;
  if (std::ranges::count_if(known, [](double of) { return of >= 0; }) < 3) return std::nullopt;
  const auto odd = std::ranges::max_element(known);
  for (auto other = known.begin(); other != known.end(); ++other)
    if (other != odd && *odd < std::max(kMuch, kTimes * *other)) return std::nullopt;
  return odd - known.begin();
}

}  // namespace rehearse::study
