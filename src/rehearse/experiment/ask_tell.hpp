#pragma once
// A robot that Rehearse does not drive: one trial at a time, by policies that are asked for and files that are told.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/experiment/past_run.hpp"
#include "rehearse/experiment/run_options.hpp"
#include "rehearse/experiment/told_file.hpp"

namespace rehearse::experiment {

/// A trial that is to come.
struct AskResult {
  Resolved resolved;
  TrialRecord trial;             // what is known before it; `theta` is θ of policy_of(trial, resolved.scenario)
  std::filesystem::path folder;  // of the policy's files
};

/// The next policy of the run in a folder, on the disk when this returns. The same until `tell_run` has had its
/// episode, whatever happens to the process. Throws InvalidInput, RunFailed and Interrupted.
AskResult ask_run(const Catalogue& catalogue, const std::filesystem::path& path, const RunOptions& options);

/// Files of what a robot did (recording/recording.hpp): the episode of the trial that was asked for, or, before
/// the first one, logs of other controllers. Several files before the first trial is told are logs, also after `ask`.
struct TellRequest {
  std::vector<std::filesystem::path> files;
  std::optional<Stop> stopped;  // the trial's episode
};

struct TellResult {
  Resolved resolved;
  std::optional<TrialRecord> trial;  // the one that the file tells; empty: they are logs
  std::vector<Log> logs;             // these
  bool known_before = false;         // the files were told already, and nothing was changed
  bool still_asked = false;          // a policy is asked for, whose trial is to come
  bool dropped = false;              // the policy that was asked for: it was made without these logs
};

/// Exactly once: files that were told before, or have the same numbers, change nothing, unless the policy that was
/// asked for says just what they have (a simulator may repeat itself exactly). Throws InvalidInput, with nothing
/// changed, where a file is not what is to come, else RunFailed and Interrupted, after which the files are told, or
/// nothing is changed.
TellResult tell_run(const Catalogue& catalogue, const std::filesystem::path& path, const TellRequest& request,
                    const RunOptions& options);

struct TakeBackResult {
  std::optional<Index> trial;                // that was told, and is to come again; empty: logs were told
  std::vector<std::filesystem::path> files;  // copies of the files that were told, in FOLDER/taken-back
};

/// Takes the last `tell_run` back, when it took the wrong file: the run's folder is as before it, byte for byte, but
/// for taken-back and a policy that was asked for, which is removed. Again, it takes back the one before. A kill costs
/// nothing: the same call goes on. Throws InvalidInput where there is none, or Rehearse drove the robot since, else
/// RunFailed and Interrupted.
TakeBackResult take_back(const Catalogue& catalogue, const std::filesystem::path& path, const RunOptions& options);

/// A run as its folder has it, for reading only: another process may be at work there.
struct RunStatus {
  PastRun run;
  bool in_use = false;
};
RunStatus status_of(const Catalogue& catalogue, const std::filesystem::path& path);

}  // namespace rehearse::experiment
