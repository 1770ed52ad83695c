#pragma once
// Plausibility checks of recordings. For the sources of this room.

#include <string>
#include <vector>

#include "rehearse/core/task.hpp"
#include "rehearse/recording/channel.hpp"
#include "rehearse/recording/problems.hpp"

namespace rehearse::recording {

/// Adds whole turns (rad) where a channel that keeps within one turn jumps by more than half of one. Returns how often.
/// Where that turn is −π to π or 0 to 2π, the channel begins in the one that is nearest to `start`.
Index unwrap(Channel& angle, double start);

/// Adds whole turns to all, so that the channel begins next to `start`.
void move_beside(Channel& angle, double start);

/// Clips actions that are beyond their bounds by no more than rounding (a thousandth of the range); others are
/// problems.
void keep_in_bounds(Channel& action, Interval bounds, Problems& problems, std::vector<std::string>& notes);

/// A problem for every jump that no robot makes: a change between neighbouring samples that is ten times as large as
/// those around it and nine of ten of all (of a state at rest: as the smallest), and larger than the spread of the
/// state, or, of a state with a rate, twice as large as the rate ever allows. One that an action explains, which stands
/// out as much there, is none. rate: null, or the channel of the rate.
void check_jumps(const Channel& state, const Channel* rate, const std::vector<Channel>& actions, Problems& problems);

/// The channel of each state's rate; null: it has none.
std::vector<const Channel*> rates_of(const std::vector<Channel>& states, const Task& task);

/// The note on a state that does not change as its rate says (note_on_rate), if there is one; else one if the rate is
/// late by a tenth of a control step or more.
void compare_with_rate(const Channel& state, const Channel& rate, double dt_s, std::vector<std::string>& notes);

/// A note if an angle turns by more than half a turn between neighbouring samples: degrees that are read as rad do.
void look_for_turns(const Channel& angle, std::vector<std::string>& notes);

}  // namespace rehearse::recording
