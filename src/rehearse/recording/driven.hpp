#pragma once
// Checks of an episode that Rehearse drove. Files that are told are checked when they are read.

#include <string>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/task.hpp"

namespace rehearse::recording {

/// Sentences on measured states: a state that jumps as none of a robot does, and states that do not change as their
/// rates say. file: of the episode, whose row k+2 has state k.
std::vector<std::string> notes_on_driven(const Task& task, const Episode& episode, const std::string& file);

}  // namespace rehearse::recording
