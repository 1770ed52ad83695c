#pragma once
// A campaign folder. For the sources of this room.

#include <filesystem>

#include "rehearse/report/files.hpp"

namespace rehearse::report {

/// Everything that the page shows of a campaign: its summary.json, and what that leaves out: parameters against truth,
/// and time spent. Throws InvalidInput if there is no usable summary.json.
Json read_campaign(const std::filesystem::path& folder, Problems& problems);

}  // namespace rehearse::report
