#include "rehearse/rollout/episodes.hpp"

namespace rehearse::rollout {

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
  episode.ended = ended[i];
}

}  // namespace rehearse::rollout
