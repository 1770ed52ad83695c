#pragma once

#include <numbers>
#include <optional>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse {

inline constexpr double kTurn = 2 * std::numbers::pi;

/// True if angles from low to high lie from −π to π or from 0 to 2π, also in single precision.
bool within_one_turn(double low, double high);

/// How many whole turns bring an angle nearest to another.
double turns_towards(double other, double angle);

/// Use it for an angle that a sensor or arctan2 gives within one turn: it counts turns on, from the one nearest to
/// `start` [rad]. Angles beyond one turn stay as they are. A change by more than π is taken for a turn, so that a robot
/// which turns faster must count itself. One thread.
class TurnCounter {
 public:
  explicit TurnCounter(double start) : start_(start) {}
  void begin();  // an episode
  double counted(double given);

 private:
  double start_, turns_ = 0;
  std::optional<double> last_;  // as it was given; none: the episode is to begin
};

/// The same for the states of a robot that are angles. One thread.
class Turns {
 public:
  Turns() = default;
  /// angles: states, of which `starts` (dx) has the means at the start.
  Turns(const std::vector<Index>& angles, const Vector& starts);
  void begin();
  Vector counted(Vector given);
  /// The true state, if it is known, in the turns of the measured one.
  Vector beside(Vector truth, const Vector& measured) const;

 private:
  std::vector<Index> angles_;
  std::vector<TurnCounter> counters_;
};

}  // namespace rehearse
