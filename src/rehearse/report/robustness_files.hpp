#pragma once
// robustness.csv of a run folder. For the sources of this room.

#include <filesystem>

#include "rehearse/report/files.hpp"

namespace rehearse::report {

/// {settings, parameters: a list of {parameter, columns}, in the order of the file}. settings: what was set of the
/// robot, as text. Null if `evaluate --robustness` was not run, or the file is unusable.
Json robustness_json(const std::filesystem::path& folder, Problems& problems);

}  // namespace rehearse::report
