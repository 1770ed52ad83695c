#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "rehearse/core/actuators.hpp"
#include "rehearse/core/episode.hpp"
#include "rehearse/core/feature_map.hpp"
#include "rehearse/core/kinematics.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/core/variables.hpp"

namespace rehearse {

/// Immediate rewards of a batch of steps: states X and actions U (rows × dx, rows × du), the states reached, one
/// reward a row. Must be callable from several threads and depend on its row alone.
using Reward = std::function<void(const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& X_next,
                                  VectorView rewards)>;

/// Steps of a batch as costs and limits see them, one a row.
struct Steps {
  const ConstMatrixView& X;         // states (rows × dx)
  const ConstMatrixView& U;         // actions (rows × du)
  const ConstMatrixView& X_next;    // the states reached
  const ConstMatrixView& U_before;  // the actions one step before; 0 in the first step
  double time_s = 0;                // since the start, when the step begins
};

/// Costs of a batch of steps, one a row: those that a reward cannot express, of changes of actions and of time. Must be
/// callable from several threads and depend on its row alone.
using StepCost = std::function<void(const Steps& steps, VectorView costs)>;

/// A condition on the steps of a batch, one number a row: 0 or NaN where it does not hold. Arguments and promises are
/// those of a cost.
using StepCondition = StepCost;

/// A condition on the states of a batch (rows × dx), one number a row: 0 or NaN where it does not hold. Promises as a
/// reward's.
using StateCondition = std::function<void(const ConstMatrixView& X, VectorView holds)>;

/// The condition that tests each state by a function of one state.
StateCondition each_state(std::function<bool(const ConstVectorView& state)> is);

/// The truth of a condition in one state (dx).
bool holds(const StateCondition& condition, const ConstVectorView& state);

/// The truth of a number that a condition wrote.
inline bool is_true(double value) { return std::abs(value) > 0; }

/// A condition that every step of an episode must keep: a track's end, a speed. The first step that does not ends the
/// episode at the reward floor, on the robot and in models.
struct Limit {
  std::string name;
  std::string text;  // "abs(x) < 0.6 m", for people
  StepCondition holds;
  double risk = 0.05;  // the largest probability, in (0, 1), that an episode of a policy breaks it
};

/// The problem as every room sees it. A plain value.
struct Task {
  std::vector<StateVariable> states;  // the robot's own, then the memory of its actuators
  std::vector<ActionVariable> actions;
  Index memory = 0;   // how many states that is (with_memory)
  Vector start_mean;  // dx
  Vector start_std;   // dx; an episode starts at N(start_mean, diag(start_std²))
  double dt_s = 0;    // control step
  Index horizon = 0;  // steps of an episode, T
  Reward reward;
  StepCost cost;          // is subtracted from the reward of each step; empty: nothing is
  Reward initial_reward;  // a guess that stands in while the reward is still to be learned; empty: none
  // Is added to the return at the end of an episode, which may have ended early: what no sum over steps can say. Any
  // thread; empty: nothing is.
  std::function<double(const Episode&)> episode_reward;
  Index rows_at_once = 0;   // that a call of its functions should have to be worth its cost; 0: any number
  double reward_floor = 0;  // charged for every step that an early end or a failed simulation leaves out

  StateCondition ended;                              // a fall; empty: never
  std::vector<Limit> limits;                         // empty: there are none
  std::function<bool(const Episode&)> solved;        // empty: never known
  std::function<Vector(const Episode&)> descriptor;  // how it went, for quality diversity; empty: none. Any thread.
  std::vector<Interval> descriptor_bounds;           // of each number of a descriptor
  std::vector<std::string> descriptor_names;         // what each is, with its unit: "tip x at 2.5 s [m]"; or empty

  Index state_size() const { return static_cast<Index>(states.size()); }
  Index action_size() const { return static_cast<Index>(actions.size()); }
  Actuators actuators() const { return {actions, dt_s, state_size() - memory}; }
  double episode_s() const { return static_cast<double>(horizon) * dt_s; }
  FeatureMap feature_map() const;     // inputs of policies
  FeatureMap model_features() const;  // of models: joint angles too, and targets from where their states are
  Kinematics kinematics() const;
  std::vector<std::string> state_names() const;
  std::vector<Interval> action_bounds() const;
  std::vector<std::string> descriptor_labels() const;  // its names; of one without, "descriptor 1", …

  /// a − b of two states (dx), angles the shorter way round.
  Vector difference(const ConstVectorView& a, const ConstVectorView& b) const;

  /// A line for everything that is missing or contradicts itself.
  std::vector<std::string> violations() const;
};

/// A task of the robot's own states, with what its actuators must remember behind them. Its functions are given all
/// states.
Task with_memory(Task task);

}  // namespace rehearse
