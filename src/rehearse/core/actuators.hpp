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
  Vector start() const;                          // memory(): as if 0, or the bound that is next to it, was always sent
  Vector scale() const;                          // memory(): the largest size of each

  /// Actions that policies want (U: rows × du) become commands. X: rows × states().
  void command(const ConstMatrixView& X, MatrixView U) const;
  /// What moves the robot, E (rows × du), in a step that begins at X under the commands U.
  void moving(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView E) const;
  /// Writes the memory's columns of X_next, which must be no part of X.
  void remember(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView X_next) const;

  /// The memory at each state of an episode with these commands (T × du) from its start: T+1 × memory().
  Matrix memory_of(const ConstMatrixView& commands) const;

  /// What is wrong with an action's actuation, a line each.
  static std::vector<std::string> violations(const ActionVariable& action, double dt_s);

  // The parts of one action, for whoever computes them elsewhere (policy/exported.hpp).
  struct Line {
    Index first = 0;         // state that is the last command; older ones follow
    Index before = 0;        // how many of them
    Index reached = -1;      // state; −1: there is no lag
    Index delay = 0;         // whole steps
    double further = 0;      // part of a step
    double passes = 1;       // the low-pass, in a step
    double max_step = kInf;  // of the command
    double stays = 0;        // exp(−dt / lag)
    double start = 0;        // of all of the memory
    double mean_stays = 0;   // mean of exp(−t / lag) over a step
  };
  const std::vector<Line>& lines() const { return lines_; }  // one an action

 private:
  auto held(const Line& line, Index action, const ConstMatrixView& X, const ConstMatrixView& U) const;

  std::vector<ActionVariable> actions_;
  std::vector<Line> lines_;
  Index own_states_ = 0, memory_ = 0;
  bool changes_commands_ = false;
};

}  // namespace rehearse
