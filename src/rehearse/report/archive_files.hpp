#pragma once
// A learner's archive of policies in a run folder. For the sources of this room.

#include <filesystem>

#include "rehearse/report/files.hpp"
#include "rehearse/report/page_data.hpp"

namespace rehearse::report {

/// The contents of elites.csv and tried.csv, and of archive.bin the size and bounds of its space: descriptors and
/// returns to 4 digits, no policies. Null if the run has no such tables, as those of other learners, or they are
/// unusable.
Json archive_json(const std::filesystem::path& folder, const ArchiveReader& read_archive, Problems& problems);

}  // namespace rehearse::report
