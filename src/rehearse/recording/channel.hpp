#pragma once
// A column of a recording as numbers. For the sources of this room.

#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::recording {

struct Sample {
  double time_s = 0;
  double value = 0;  // in the task's unit
  Index row = 0;     // of the file; the header is 1
};

/// Samples in the order of time, without those that are missing.
struct Channel {
  std::string name, unit;
  std::vector<Sample> samples;
};

/// The columns that a task wants; each has a sample at least.
struct Channels {
  std::vector<Channel> states, actions;
  std::vector<Channel> truths;  // none, or one a state
  std::string time = {};        // its column,
  std::string time_unit = {};   // and the unit there; empty: none, so it is in s
};

}  // namespace rehearse::recording
