#pragma once
// The columns of a table that a task wants. For the sources of this room.

#include <string>
#include <vector>

#include "rehearse/core/task.hpp"
#include "rehearse/files/table.hpp"
#include "rehearse/recording/channel.hpp"
#include "rehearse/recording/problems.hpp"

namespace rehearse::recording {

/// Finds, converts and checks: columns, cells that are no numbers, the order of times. Rows before time 0 are left out.
/// Wrong input becomes problems, and then the channels are of no use.
Channels find_channels(const files::Table& table, const Task& task, Problems& problems,
                       std::vector<std::string>& notes);

}  // namespace rehearse::recording
