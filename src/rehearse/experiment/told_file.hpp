#pragma once
// Files of episodes that were not run by Rehearse.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/experiment/record.hpp"
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
  std::string checksum;  // 16 digits
};

/// Throws InvalidInput for each that cannot be read, or is there twice.
std::vector<ToldFile> read_told_files(const std::vector<std::filesystem::path>& paths);

/// Whole files, whatever their length. Rewards are those of the measured states.
std::vector<Log> logs_of(const std::vector<ToldFile>& files, const Task& task);

/// Whether its actions are those that the policy of a trial says of its states, but for rounding. False of a file that
/// cannot be read.
bool follows_policy(const ToldFile& file, const scenario::Scenario& scenario, const TrialRecord& asked);

struct ToldEpisode {
  Episode episode;
  std::vector<std::string> notes;  // how the file was read, and what is unlike the policy that was asked for
};

/// The episode of a trial that was asked for. Throws InvalidInput if it is shorter than the task's horizon, and neither
/// a fall nor `stopped` says why.
ToldEpisode episode_of(const ToldFile& file, const scenario::Scenario& scenario, const TrialRecord& asked,
                       const std::optional<Stop>& stopped);

}  // namespace rehearse::experiment
