#include "rehearse/experiment/forecast.hpp"

#include "rehearse/rollout/forecast.hpp"

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

}  // namespace

std::vector<ForecastError> forecast_errors(const dynamics::DynamicsModel& model, const Task& task,
                                           const Episode& episode, const Evaluator& evaluator) {
  const std::vector<Index> horizons = horizons_up_to(episode.steps());
  const std::vector<Matrix> predicted = rollout::forecast(model, episode, horizons, evaluator);
  std::vector<ForecastError> errors;
  for (std::size_t i = 0; i < horizons.size(); ++i) errors.push_back(compare(task, episode, horizons[i], predicted[i]));
  return errors;
}

}  // namespace rehearse::experiment
