#pragma once

#include "rehearse/core/random.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse::system {

/// The system that a trial runs on: a real robot, a simulator playing one, an external program. Stateful; one thread.
class Plant {
 public:
  virtual ~Plant() = default;

  /// Starts an episode; draws what is random about it from `rng`, and keeps a copy of it for the steps to come.
  /// Returns the measured state (dx).
  virtual Vector reset(Rng& rng) = 0;

  /// Applies action u (du, inside its bounds) for one control step. Returns the measured state (dx). Throws
  /// std::exception if the robot does not answer.
  virtual Vector step(const Vector& u) = 0;

  /// True if the last step ended the episode: a fall that only the robot itself can detect.
  virtual bool ended() const { return false; }

  /// The noise-free state where it is known, else an empty vector.
  virtual Vector truth() const { return {}; }
};

}  // namespace rehearse::system
