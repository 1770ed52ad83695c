#include "rehearse/experiment/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rehearse/rollout/forecast.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::experiment {
namespace {

std::vector<Index> horizons_up_to(Index steps) {
  std::vector<Index> horizons;
  for (Index decade = 1; decade <= steps; decade *= 10)
    for (Index factor : {1, 2, 5})
      if (factor * decade <= steps) horizons.push_back(factor * decade);
  return horizons;
}

/// predicted: what rollout::forecast gives for this horizon.
ForecastError compare(const Task& task, const Episode& episode, Index horizon, const Matrix& predicted) {
  ForecastError error{horizon, 0, 0, Vector::Zero(predicted.cols())};
  for (Index i = 0; i < predicted.rows(); ++i) {
    const Vector off = task.difference(predicted.row(i).transpose(), episode.states.row(horizon + i).transpose());
    if (!off.allFinite()) {
      ++error.failed;
      continue;
    }
    ++error.compared;
    error.rms += off.cwiseAbs2();
  }
  error.rms = (error.rms / static_cast<double>(error.compared)).cwiseSqrt();  // 0/0 is NaN, as promised
  return error;
}

std::vector<double> sorted_finite(const Matrix& states, Index column) {
  std::vector<double> values;
  for (double value : states.col(column))
    if (std::isfinite(value)) values.push_back(value);
  std::sort(values.begin(), values.end());
  return values;
}

/// The mean, computed relative to the first value, so that the mean of equal values is that value.
double mean(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (double value : values) sum += value - values.front();
  return values.front() + sum / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  if (values.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const double middle = mean(values);
  double sum = 0;
  for (double value : values) sum += (value - middle) * (value - middle);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

}  // namespace

std::vector<ForecastError> forecast_errors(const dynamics::DynamicsModel& model, const Task& task,
                                           const Episode& episode, const Evaluator& evaluator) {
  const std::vector<Index> horizons = horizons_up_to(episode.steps());
  const std::vector<Matrix> predicted = rollout::forecast(model, episode, horizons, evaluator);
  std::vector<ForecastError> errors;
  for (std::size_t i = 0; i < horizons.size(); ++i) errors.push_back(compare(task, episode, horizons[i], predicted[i]));
  return errors;
}

Vector mean_of_finite(const Matrix& states) {
  Vector means(states.cols());
  for (Index s = 0; s < states.cols(); ++s) means(s) = mean(sorted_finite(states, s));
  return means;
}

Vector deviations_of_finite(const Matrix& states) {
  Vector found(states.cols());
  for (Index s = 0; s < states.cols(); ++s) found(s) = deviation(sorted_finite(states, s));
  return found;
}

Vector quantiles(const Matrix& states, double fraction) {
  Vector found(states.cols());
  for (Index s = 0; s < states.cols(); ++s) found(s) = statistics::quantile(sorted_finite(states, s), fraction);
  return found;
}

}  // namespace rehearse::experiment
