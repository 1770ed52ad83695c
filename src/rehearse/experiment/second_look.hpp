#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/experiment/run_options.hpp"

namespace rehearse::experiment {

/// A second look at a run of which three trials or more did not solve the task, in lines for people; else empty.
struct SecondLook {
  std::vector<std::string> readings;  // with which the prior's parameters would predict the trials much better
  std::string read_on;                // where there is more on trials that do not get better
};

/// Looks for other readings of the trials, such as a delay of the actions, as `identify` does in logs. None are found
/// where that takes longer than some seconds, or the prior fails. Throws InvalidInput if it is no run folder.
SecondLook second_look(const Catalogue& catalogue, const std::filesystem::path& folder, const RunOptions& options);

}  // namespace rehearse::experiment
