#include "rehearse/rollout/episodes.hpp"

#include <cmath>

namespace rehearse::rollout {

void Episodes::begin(const Task& task, const Matrix& start) {
  const auto rows = static_cast<std::size_t>(start.rows());
  states.resize(static_cast<std::size_t>(task.horizon + 1));
  actions.resize(static_cast<std::size_t>(task.horizon));
  rewards.resize(start.rows(), task.horizon);
  reward_floor = task.reward_floor;
  steps.assign(rows, 0);
  ended.assign(rows, false);
  failed.assign(rows, false);
  for (Matrix& at : states) at.resize(start.rows(), start.cols());
  for (Matrix& at : actions) at.resize(start.rows(), task.action_size());
  states.front() = start;
}

void Episodes::finish(const Task& task, const Vector& of_steps) {
  returns = of_steps;
  episode_rewards.resize(0);
  if (!task.episode_reward) return;
  Vector all(rows());
  Episode episode;
  for (Index row = 0; row < rows(); ++row) {
    copy(row, episode);
    all(row) = episode_reward_of(task, episode);
  }
  returns += all;
  episode_rewards = all;
}

void Episodes::copy(Index row, Episode& episode) const {
  const auto i = static_cast<std::size_t>(row);
  const Index T = steps[i];
  episode.states.resize(T + 1, states.front().cols());
  episode.actions.resize(T, actions.front().cols());
  for (Index t = 0; t <= T; ++t) episode.states.row(t) = states[static_cast<std::size_t>(t)].row(row);
  for (Index t = 0; t < T; ++t) episode.actions.row(t) = actions[static_cast<std::size_t>(t)].row(row);
  episode.true_states = episode.states;
  episode.rewards = rewards.row(row).head(T).transpose();
  episode.charged = static_cast<double>(rewards.cols() - T) * reward_floor;
  episode.episode_reward = episode_rewards.size() > 0 ? episode_rewards(row) : 0;
  episode.ended = ended[i] || failed[i];  // as `execute` has it
}

double episode_reward_of(const Task& task, const Episode& episode) {
  const double reward = task.episode_reward(episode);
  return std::isfinite(reward) ? reward : task.reward_floor;
}

}  // namespace rehearse::rollout
