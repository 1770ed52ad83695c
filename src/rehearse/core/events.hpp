#pragma once

#include <functional>
#include <string>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// The progress of a long computation. Rooms emit these events; only apps print them.
struct Progress {
  std::string phase;   // "model", "search"
  double done = 0;     // fraction of the phase, 0..1
  double best = 0;     // best predicted return so far; NaN: not known
  Index rollouts = 0;  // simulated so far in this phase
  double rollouts_per_s = 0;
};

/// Receives progress on the learner's own thread; may throw Interrupted to stop at a safe point. Empty: nobody listens.
using ProgressSink = std::function<void(const Progress&)>;

/// Thrown out of a learner when its user asked to stop; everything told so far is kept. It is no std::exception.
struct Interrupted {};

}  // namespace rehearse
