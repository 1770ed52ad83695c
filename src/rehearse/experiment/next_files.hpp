#pragma once
// The files of a policy that was asked for, for the sources of this room.

#include "rehearse/experiment/record.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/run_folder.hpp"

namespace rehearse::experiment {

/// Writes them, as C, JSON and a NumPy module, or, if no trial is asked for, removes those of the last one: nobody may
/// run them again by mistake.
void update_next_files(const RunFolder& folder, const Resolved& resolved, const History& history);

}  // namespace rehearse::experiment
