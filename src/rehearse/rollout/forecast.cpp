#include "rehearse/rollout/forecast.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::rollout {
namespace {

constexpr Index kFollowedAtOnce = 64;  // rows of a task of the evaluator

/// The predicted states; failed ones, which are no input for a model or a policy, replaced by rows of `others`.
Matrix known_states(const Matrix& predicted, const Matrix& others) {
  Matrix states = predicted;
  for (Index i = 0; i < states.rows(); ++i)
    if (!states.row(i).allFinite()) states.row(i) = others.row(i);
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
  Matrix predicted = episode.states.topRows(episode.steps()), mean;
  Index step = 0;
  for (const Index horizon : horizons) {
    for (; step < horizon; ++step) {  // row t started at step t and has come to t + step
      evaluator.stop_if_asked();
      const Index rows = episode.steps() - step;
      predicted.conservativeResize(rows, Eigen::NoChange);
      mean.resize(rows, predicted.cols());
      model.predict_mean(known_states(predicted, episode.states), episode.actions.middleRows(step, rows), mean);
      predicted += mean;  // a state that has failed stays NaN
    }
    arrived.push_back(predicted);
  }
  return arrived;
}

Matrix follow(const dynamics::DynamicsModel& model, const Task& task, const FixedPolicy& policy, const Matrix& states,
              Index steps, const Evaluator& evaluator) {
  Matrix arrived = states;
  const Actuators actuators = task.actuators();
  const Index chunks = (states.rows() + kFollowedAtOnce - 1) / kFollowedAtOnce;
  evaluator.for_each(chunks, [&](Index chunk) {
    const Index first = chunk * kFollowedAtOnce, rows = std::min(kFollowedAtOnce, states.rows() - first);
    const Matrix from = states.middleRows(first, rows), Theta = policy.theta.transpose().replicate(rows, 1);
    Matrix now = from, change(rows, states.cols()), actions(rows, task.action_size());
    for (Index t = 0; t < steps; ++t) {
      evaluator.stop_if_asked();
      const Matrix known = known_states(now, from);
      policy.policy.act(Theta, known, static_cast<double>(t) * task.dt_s, actions);
      actuators.command(known, actions);
      model.predict_mean(known, actions, change);
      now += change;
    }
    for (Index i = 0; i < rows; ++i)
      if (!now.row(i).allFinite()) now.row(i).setConstant(kNaN);
    arrived.middleRows(first, rows) = now;
  });
  return arrived;
}

}  // namespace rehearse::rollout
