#include "rehearse/core/episode.hpp"

namespace rehearse {
namespace {

void append_rows(Matrix& matrix, const Matrix& rows) {
  const Index before = matrix.rows();
  matrix.conservativeResize(before + rows.rows(), rows.cols());
  matrix.bottomRows(rows.rows()) = rows;
}

}  // namespace

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
