#include "rehearse/core/episode_fit.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse {

std::vector<std::string> misfits(const Episode& episode, const Task& task) {
  std::vector<std::string> lines;
  const auto look = [&](const char* name, const Matrix& numbers, Index rows, Index columns) {
    if (numbers.rows() != rows || numbers.cols() != columns) {
      lines.push_back(fmt::format("the episode's {} are {} × {}, must be {} × {}", name, numbers.rows(), numbers.cols(),
                                  rows, columns));
      return;
    }
    for (Index row = 0; row < rows; ++row)
      for (Index column = 0; column < columns; ++column)
        if (!std::isfinite(numbers(row, column))) {
          lines.push_back(
              fmt::format("the episode's {}({}, {}) = {}, must be finite", name, row, column, numbers(row, column)));
          return;
        }
  };
  const Index steps = episode.steps();
  look("states", episode.states, steps + 1, task.state_size());
  look("true_states", episode.true_states, steps + 1, task.state_size());
  look("actions", episode.actions, steps, task.action_size());
  look("rewards", episode.rewards, steps, 1);
  return lines;
}

void require_fit(const Episode& episode, const Task& task) {
  Violations found;
  found.add(misfits(episode, task));
  found.throw_if_any();
}

}  // namespace rehearse
