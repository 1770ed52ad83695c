#include "rehearse/core/episode.hpp"

#include <algorithm>
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

Dataset spread_rows(const std::vector<Episode>& logs, Index rows, Index length) {
  if (logs.empty()) return {};
  length = std::clamp<Index>(rows / std::ssize(logs), 1, length);  // each log has a stretch
  Index all = 0;
  for (const Episode& log : logs) all += log.steps();
  Dataset data;
  for (const Episode& log : logs) {
    const double share = std::min(1.0, static_cast<double>(rows) / static_cast<double>(all));
    const double wanted = share * static_cast<double>(log.steps());
    const auto stretches = std::max<Index>(1, std::llround(wanted / static_cast<double>(length)));
    if (share == 1 || stretches * length >= log.steps()) {
      data.append(log);
      continue;
    }
    const Index room = log.steps() - length;
    for (Index i = 0; i < stretches; ++i)
      data.append(log.part(stretches == 1 ? room / 2 : i * room / (stretches - 1), length));
  }
  return data;
}

}  // namespace rehearse
