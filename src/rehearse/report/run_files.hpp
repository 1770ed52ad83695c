#pragma once
// A run folder. For the sources of this room.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rehearse/report/files.hpp"
#include "rehearse/report/page_data.hpp"

namespace rehearse::report {

/// A run as spec.toml describes it.
struct RunSpec {
  std::string scenario, learner, prior;  // prior: empty without one
  Index trials = 0, seed = 0;
  std::vector<std::pair<std::string, std::string>> options;  // key and value as text, in the order of the file

  /// The value that a parameter has in the plant, where the scenario says it (`plant.NAME`). name: as in `phi.NAME`,
  /// where parameters of one prior among several are called NAME@PRIOR.
  std::optional<double> truth(const std::string& name) const;
};

/// Throws InvalidInput if it cannot be read, or another version of Rehearse wrote it.
RunSpec read_spec(const std::filesystem::path& folder);

/// Names of the tunable parameters: the columns phi.NAME of a trials.csv.
std::vector<std::string> parameter_names(const files::Table& trials);

/// Says what is damaged or missing in the folder of a run that has `trials` trials, without reading all of it.
/// where: what to call the folder in problems.
void check_run_folder(const std::filesystem::path& folder, const std::filesystem::path& where, Index trials,
                      Problems& problems);

/// Everything that the page shows of a run. only: if given, the one trial whose episode is wanted.
Json read_run(const std::filesystem::path& folder, std::optional<Index> only, const Knowledge& knowledge,
              Problems& problems);

}  // namespace rehearse::report
