#pragma once

#include <string>
#include <vector>

#include "rehearse/core/types.hpp"
#include "rehearse/core/variables.hpp"

namespace rehearse {

/// From the action that a policy wants, over the command that is sent, to the action that moves the robot.
///
///     command = command before + what the low-pass lets through of (wanted − command before), at most max_rate · dt
///     held    = the mean over the step of the command delay_s ago, which whole steps before have sent
///     reached = held + (reached before − held) exp(−dt / lag_s)
///
/// The robot is moved by `held`, or with a lag by the mean over the step of the way to `reached`. These formulas need
/// numbers of steps before, which are further states of the task, its memory: NAME_last, NAME_last2, …, NAME_reached
/// stand behind the robot's own states. So a policy sees them, and the loops over time are those of any task. A value;
/// const methods may run concurrently.
class Actuators {
 public:
  static constexpr double kMostSteps = 100;  // of a delay, and of commands that are remembered

  Actuators() = default;
  /// own_states: those of the robot, which stand first.
  Actuators(const std::vector<ActionVariable>& actions, double dt_s, Index own_states);

  Index own_states() const { return own_states_; }
  Index memory() const { return memory_; }  // states behind these
  Index states() const { return own_states_ + memory_; }
  bool changes_commands() const { return changes_commands_; }  // a rate or a low-pass is set

  std::vector<StateVariable> variables() const;  // of the memory
  Vector start() const;                          // memory(): as if 0, or the bound nearest to 0, had always been sent
  Vector scale() const;                          // memory(): the largest size of each

  /// Actions that policies want (U: rows × du) become commands. X: rows × states().
  void command(const ConstMatrixView& X, MatrixView U) const;
  /// The actions that move the robot, E (rows × du), in a step that begins at X under the commands U.
  void moving(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView E) const;
  /// Writes the memory's columns of X_next, which must be no part of X.
  void remember(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView X_next) const;

  /// The memory at each state of an episode with these commands (T × du) from its start: T+1 × memory().
  Matrix memory_of(const ConstMatrixView& commands) const;

  /// The violations in an action's actuation, a line each.
  static std::vector<std::string> violations(const ActionVariable& action, double dt_s);

  /// The numbers that turn one action's commands into what moves the robot, for exported policies
  /// (policy/exported.hpp). The action's part of the memory holds the last `kept` commands, newest first, and, with a
  /// lag, the value reached.
  struct Channel {
    Index last_command = 0;     // state
    Index kept = 0;             // commands
    Index reached_state = -1;   // −1: there is no lag
    Index delay_steps = 0;      // whole control steps of the delay …
    double delay_fraction = 0;  // … and the rest of it, in steps
    double filter_gain = 1;     // 1 − exp(−dt / filter_s): part of a change that passes in a step; 1: no filter
    double max_change = kInf;   // of the command in a step
    double lag_decay = 0;       // exp(−dt / lag_s)
    double mean_lag_decay = 0;  // mean of exp(−t / lag_s) over a step
    double start_command = 0;   // all of the memory at the start
  };
  const std::vector<Channel>& channels() const { return channels_; }  // one an action

 private:
  auto held(const Channel& channel, Index action, const ConstMatrixView& X, const ConstMatrixView& U) const;

  std::vector<ActionVariable> actions_;
  std::vector<Channel> channels_;
  Index own_states_ = 0, memory_ = 0;
  bool changes_commands_ = false;
};

}  // namespace rehearse
