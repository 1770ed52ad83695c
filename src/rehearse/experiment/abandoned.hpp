#pragma once
// The hidden folders of runs that were killed while their folder was made (files/new_folder.hpp).

#include <array>
#include <filesystem>

namespace rehearse::experiment {

/// The folders with which a run folder begins.
inline constexpr std::array<const char*, 2> kFirstFolders = {"trajectories", "predictions"};

/// Removes the hidden folders that killed processes left beside `path` while they made this run folder. A folder goes
/// only if nothing is in it but what a run begins with, and nobody holds its lock.
void remove_abandoned(const std::filesystem::path& path);

}  // namespace rehearse::experiment
