#pragma once

#include <vector>

#include "rehearse/core/task.hpp"

namespace rehearse::rollout {

/// Simulated episodes, one a row of a batch. What a row has after its early end is not defined.
struct Episodes {
  std::vector<Matrix> states;   // T+1 of rows × dx
  std::vector<Matrix> actions;  // T of rows × du
  Matrix rewards;               // rows × T
  Vector returns;               // rows, with what was charged for an early end, and the rewards of whole episodes
  Vector episode_rewards;       // rows, of whole episodes; empty: the task has none
  std::vector<Index> steps;     // made before the end
  std::vector<char> ended;      // by a fall or a broken limit: its state is the last one
  std::vector<char> failed;     // by a prediction that was not finite: this one is left out
  double reward_floor = 0;      // the task's

  Index rows() const { return returns.size(); }
  /// Before the first step: of these start states (rows × dx), without steps.
  void begin(const Task& task, const Matrix& start);
  /// After the last step. of_steps (rows): what the steps earned, and what was charged.
  void finish(const Task& task, const Vector& of_steps);
  /// Writes all of an episode but its failure and the names of broken limits, which simulated ones do not have.
  /// Allocates only where the episode has another size.
  void copy(Index row, Episode& episode) const;
};

/// Task::episode_reward, which the task has, of an episode; the reward floor where it is not finite.
double episode_reward_of(const Task& task, const Episode& episode);

}  // namespace rehearse::rollout
