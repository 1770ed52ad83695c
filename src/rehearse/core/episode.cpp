#include "rehearse/core/episode.hpp"

#include <cmath>

namespace rehearse {
namespace {

void append_rows(Matrix& matrix, const Matrix& rows) {
  const Index before = matrix.rows();
  matrix.conservativeResize(before + rows.rows(), rows.cols());
  matrix.bottomRows(rows.rows()) = rows;
}

}  // namespace

Episode Episode::part(Index first, Index steps) const {
  return {.states = states.middleRows(first, steps + 1),
          .true_states = true_states.middleRows(first, steps + 1),
          .actions = actions.middleRows(first, steps),
          .rewards = rewards.segment(first, steps)};
}

double seconds(Index steps, double dt_s) { return std::round(static_cast<double>(steps) * dt_s * 1e9) / 1e9; }

void Dataset::append(const Episode& episode) {
  const Index steps = episode.steps();
  if (steps == 0) return;
  append_rows(states, episode.states.topRows(steps));
  append_rows(actions, episode.actions);
  append_rows(changes, episode.states.bottomRows(steps) - episode.states.topRows(steps));
  rewards.conservativeResize(rewards.size() + steps);
  rewards.tail(steps) = episode.rewards;
}

}  // namespace rehearse
