#pragma once
// Channels with times of their own → control steps. For the sources of this room.

#include <string>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/recording/channel.hpp"
#include "rehearse/recording/problems.hpp"

namespace rehearse::recording {

/// The times at which control steps begin: start_s + k·dt_s, k = 0..steps.
struct Grid {
  double start_s = 0, dt_s = 0;
  Index steps = 0;

  double time(Index k) const { return start_s + static_cast<double>(k) * dt_s; }
};

/// From where all channels have begun to where a state ends, or the last action, which holds for a step or, where rows
/// are further apart, until the next would come: for a last action no longer than `max_gap_s`. The last step
/// may lack half of the time from row to row, half a step at most. A problem if all that is less than a step.
Grid grid_of(const Channels& channels, double dt_s, double max_gap_s, Problems& problems);

/// Leaves out samples that no step of the grid needs, behind its end.
void cut(Channels& channels, const Grid& grid);

/// A problem if neighbouring samples that the grid needs are more than `max_gap_s` apart.
void check_gaps(const Channels& channels, const Grid& grid, double max_gap_s, Problems& problems);

/// Steps that are not rows of the file as they are, and steps whose states are on lines through rows.
struct Resampled {
  Index states = 0, actions = 0;
  Index on_lines = 0;
  Matrix unaveraged;  // the states as without `average`; empty without it
};

/// The episode on the grid (recording.hpp says how).
Resampled resample(const Channels& channels, const Grid& grid, bool average, Episode& episode);

}  // namespace rehearse::recording
