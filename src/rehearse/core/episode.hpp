#pragma once

#include <string>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// The record of one trial of T steps. An episode that ended early has fewer steps than the task's horizon.
struct Episode {
  Matrix states;                           // (T+1) × dx, measured: what policies and data sets see
  Matrix true_states;                      // (T+1) × dx, noise-free where the plant knows it, else the measured ones
  Matrix actions;                          // T × du
  Vector rewards;                          // T; rewards(t) is that of the state reached, t+1
  double charged = 0;                      // reward floor charged for the steps that an early end left out
  double episode_reward = 0;               // Task::episode_reward of all of it
  bool ended = false;                      // by a fall, a broken limit, or by what `failure` says
  std::string failure;                     // "the reward at step 5 is nan"; empty: there was none
  std::vector<std::string> broken_limits;  // names of those that the last step broke

  Index steps() const { return actions.rows(); }
  double total_reward() const {
    const double of_steps = rewards.sum() + charged;
    return episode_reward == 0 ? of_steps : of_steps + episode_reward;  // −0 stays −0
  }

  /// True if an operator stopped it by no fault of the policy: its return does not compare with those of whole
  /// episodes.
  bool is_cut_short(Index horizon) const { return !ended && steps() < horizon; }

  /// True if the measured states and the actions of another are these.
  bool has_numbers_of(const Episode& other) const {  // Eigen compares matrices of equal sizes
    return steps() == other.steps() && states == other.states && actions == other.actions;
  }

  /// Steps first to first + steps, as an episode of its own that did not end early.
  Episode part(Index first, Index steps) const;
};

/// The duration of so many control steps, to the nanosecond, so that 3 × 0.05 is 0.15.
double seconds(Index steps, double dt_s);

/// The training data of models: one row per observed step.
struct Dataset {
  Matrix states;   // n × dx
  Matrix actions;  // n × du
  Matrix changes;  // n × dx, next state − state
  Vector rewards;  // n, of the states reached

  Index size() const { return states.rows(); }
  void append(const Episode& episode);
};

/// Evenly spread stretches of `length` steps, about `rows` steps of all logs; all, where they have no more.
Dataset spread_rows(const std::vector<Episode>& logs, Index rows, Index length);

}  // namespace rehearse
