#include "rehearse/rollout/forecast.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::rollout {
namespace {

/// The predicted states; failed ones, which are no input for a model, replaced by states of the episode.
Matrix known_states(const Matrix& predicted, const Episode& episode) {
  Matrix states = predicted;
  for (Index i = 0; i < states.rows(); ++i)
    if (!states.row(i).allFinite()) states.row(i) = episode.states.row(i);
  return states;
}

}  // namespace

std::vector<Matrix> forecast(const dynamics::DynamicsModel& model, const Episode& episode,
                             const std::vector<Index>& horizons, const Evaluator& evaluator) {
  for (std::size_t i = 0; i < horizons.size(); ++i)
    if (horizons[i] < (i > 0 ? horizons[i - 1] : 1) || horizons[i] > episode.steps())
      throw InvalidInput(fmt::format("horizon {} of a forecast, must be ascending and within the {} steps", horizons[i],
                                     episode.steps()));
  std::vector<Matrix> arrived;
  Matrix predicted = episode.states.topRows(episode.steps()), mean, variance;
  Index step = 0;
  for (const Index horizon : horizons) {
    for (; step < horizon; ++step) {  // row t started at step t and has come to t + step
      evaluator.stop_if_asked();
      const Index rows = episode.steps() - step;
      predicted.conservativeResize(rows, Eigen::NoChange);
      mean.resize(rows, predicted.cols());
      variance.resize(rows, predicted.cols());
      model.predict(known_states(predicted, episode), episode.actions.middleRows(step, rows), mean, variance);
      predicted += mean;  // what has failed stays NaN
    }
    arrived.push_back(predicted);
  }
  return arrived;
}

}  // namespace rehearse::rollout
