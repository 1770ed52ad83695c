#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/experiment/run_options.hpp"

namespace rehearse::apps {

/// Lines for people where three trials or more did not solve the task; else none. They have every reading of the trials
/// with which the prior's parameters would predict them much better, such as a delay of the actions, as `identify`
/// finds them in logs, and where to read on. Nothing is said of readings where that takes longer than some seconds, or
/// the prior fails.
std::vector<std::string> second_look(const experiment::Catalogue& catalogue, const std::filesystem::path& folder,
                                     const experiment::RunOptions& options);

}  // namespace rehearse::apps
