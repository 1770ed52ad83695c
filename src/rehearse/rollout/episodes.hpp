#pragma once

#include <vector>

#include "rehearse/core/episode.hpp"

namespace rehearse::rollout {

/// Simulated episodes, one a row of a batch.
struct Episodes {
  std::vector<Matrix> states;   // T+1 of rows × dx
  std::vector<Matrix> actions;  // T of rows × du
  Matrix rewards;               // rows × T
  Vector returns;               // rows, with what was charged for an early end
  std::vector<Index> steps;     // made before the end
  std::vector<char> ended;      // by a fall or a broken limit: its state is the last one
  std::vector<char> failed;     // by a prediction that was not finite: this one is left out
  double reward_floor = 0;      // the task's

  Index rows() const { return returns.size(); }
  /// Allocates only where the episode has another size.
  void copy(Index row, Episode& episode) const;
};

}  // namespace rehearse::rollout
