#pragma once
// A run folder while it is made: beside the one that it becomes, on the same file system, under a hidden name.

#include <filesystem>
#include <optional>
#include <string>

namespace rehearse::experiment {

/// NAME of ".NAME.PROCESS", or nothing.
std::optional<std::string> name_of_unborn(const std::string& entry);

/// Makes the folder that becomes `path`. Removes first what processes left beside it that were killed while they made
/// the same run: folders with nothing in them but what a run begins with. Throws InvalidInput.
std::filesystem::path make_unborn(const std::filesystem::path& path);

}  // namespace rehearse::experiment
