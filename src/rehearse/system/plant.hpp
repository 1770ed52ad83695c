#pragma once

#include "rehearse/core/random.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse::system {

/// The system that a trial runs on: a real robot, a simulator playing one, an external program. Angles count turns on;
/// `with_turns_counted` (counted_turns.hpp) is for robots that measure them within one. Stateful; one thread.
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

  /// The end of an episode, whatever ended it: nothing is to move the robot until the next reset.
  virtual void finish() noexcept {}

  /// Throws std::exception where the end of the last episode went wrong, as the next reset does.
  virtual void require_finished() {}

  /// The noise-free state where it is known, else an empty vector.
  virtual Vector truth() const { return {}; }
};

/// Finishes a plant's episode where it goes out of scope.
class EpisodeOn {
 public:
  explicit EpisodeOn(Plant& plant) : plant_(plant) {}
  ~EpisodeOn() { plant_.finish(); }
  EpisodeOn(const EpisodeOn&) = delete;
  EpisodeOn& operator=(const EpisodeOn&) = delete;

 private:
  Plant& plant_;
};

}  // namespace rehearse::system
