#pragma once

#include <algorithm>
#include <chrono>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// Measures the time since its construction. For the log and the console; must not decide results.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  /// The rate per second of something that happened `count` times since the start.
  double per_s(Index count) const { return static_cast<double>(count) / std::max(seconds(), 1e-9); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The duration of `work()`.
template <class Work>
double seconds(Work&& work) {
  const Stopwatch watch;
  work();
  return watch.seconds();
}

}  // namespace rehearse
