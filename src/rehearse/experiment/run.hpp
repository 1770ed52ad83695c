#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/experiment/record.hpp"
#include "rehearse/experiment/run_options.hpp"
#include "rehearse/experiment/run_store.hpp"

namespace rehearse::experiment {

struct RunResult {
  std::filesystem::path folder;
  Index trials = 0;
  std::optional<Index> solved_at;     // the first trial that solved the task
  double best_return = 0;             // of no trials: 0
  std::vector<std::string> warnings;  // what the trials could not tell of φ, as of the last trial's model; and faults
};

/// Runs a spec in a new folder. Throws InvalidInput before the folder exists, then RunFailed or Interrupted.
RunResult start_run(const Catalogue& catalogue, const Spec& spec, const std::filesystem::path& folder,
                    const RunOptions& options);

/// Continues the run in a folder to its end, or to another one. Throws the same.
RunResult resume_run(const Catalogue& catalogue, const std::filesystem::path& folder, std::optional<Until> until,
                     const RunOptions& options);

}  // namespace rehearse::experiment
