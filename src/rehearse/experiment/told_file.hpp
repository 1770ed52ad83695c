#pragma once
// Files of episodes that Rehearse did not run.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/record.hpp"
#include "rehearse/recording/recording.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::experiment {

/// An episode that the operator cut short.
struct Stop {
  std::string reason;
  bool at_fault = true;  // the policy: the steps that are left out are charged the reward floor
};

struct ToldFile {
  std::filesystem::path path;
  std::string bytes;
  std::string checksum;                       // 16 digits
  std::optional<recording::Recording> whole;  // what `readable` says, once it was asked: long files take seconds
};

/// The files that can be read, each once; the others become violations.
std::vector<ToldFile> read_told_files(const std::vector<std::filesystem::path>& paths, Violations& violations,
                                      const recording::ReadOptions& options = {});

/// Whole files, whatever their length. Rewards are those of the measured states.
std::vector<Log> logs_of(const std::vector<ToldFile>& files, const Task& task);

/// A whole file; empty if it cannot be read.
std::optional<recording::Recording> readable(const ToldFile& file, const Task& task);

/// A note where much of a log is beyond the end of a trial: a column may be in another unit than it says.
std::vector<std::string> notes_on_ends(const Episode& log, const Task& task);

/// True if a file that was read so has just the numbers of an episode that is kept, of which so many steps at most were
/// taken, and none after its end.
bool repeats(const Episode& read, const Episode& kept, Index most_steps);

/// True if a file that was read so goes on where an operator, and no fall, ended the episode that is kept.
bool goes_on_after(const Episode& read, const Episode& kept, const Task& task);

/// True if the actions that were read are those of a trial's policy in the states, but for rounding.
bool follows_policy(const recording::Recording& read, const scenario::Scenario& scenario, const TrialRecord& asked);

/// The same as exactly as motors are, in a loop with a clock of its own.
bool may_follow_policy(const recording::Recording& read, const scenario::Scenario& scenario, const TrialRecord& asked);

struct ToldEpisode {
  Episode episode;
  std::vector<std::string> notes;  // remarks on reading, and differences from the policy that was asked for
};

/// The episode of a trial that was asked for, after the earlier ones. Throws InvalidInput if it is shorter than the
/// task's horizon, and neither a fall nor `stopped` says why.
ToldEpisode episode_of(const ToldFile& file, const scenario::Scenario& scenario, const TrialRecord& asked,
                       const std::vector<TrialRecord>& earlier, const std::optional<Stop>& stopped);

}  // namespace rehearse::experiment
