#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rehearse/campaign/plan.hpp"
#include "rehearse/files/table.hpp"

namespace rehearse::campaign {

enum class RunState { unfinished, done, failed };

/// A planned run as far as it is known.
struct RunOutcome {
  RunState state = RunState::unfinished;
  std::string reason;                          // why it failed, in one line
  bool unusable = false;                       // failed since its folder cannot be read, and is not tried again
  files::Table trials;                         // its trials.csv, up to as many trials as are planned
  std::vector<double> interaction_s, returns;  // of these, by trial
  std::vector<std::optional<bool>> solved;     // empty: the scenario cannot say

  Index done() const { return static_cast<Index>(returns.size()); }
  void fail(std::string why);

  /// The trial that counts as trial `trial`: itself, or the last of a run that ended before because the task was
  /// solved. Nothing if it was not reached.
  std::optional<std::size_t> row_of(Index trial) const;

  /// True if trial `trial` was reached, or never will be.
  bool decided(Index trial) const { return row_of(trial) || state == RunState::failed; }

  /// The first trial up to `until` that solved the task, if any did.
  std::optional<Index> first_success(Index until) const;

  /// The best return of the trials up to `until`, of which there must be one.
  double best_return(Index until) const;
};

/// Something in a campaign's folder that is none of its own.
struct Skipped {
  std::string path, reason;
};

/// A plan and how far it has come. runs[i] belongs to plan.runs[i].
struct Campaign {
  CampaignPlan plan;
  std::vector<RunOutcome> runs;
  std::vector<Skipped> skipped;

  const RunOutcome& outcome(std::size_t group, std::size_t seed) const { return runs[plan.index_of(group, seed)]; }
  Index count(RunState state) const;
  Index count(RunState state, std::size_t group) const;
  /// A line for each learner that is missing, each thing in the folder that is none of its own, and each run whose
  /// folder cannot be used.
  std::vector<std::string> remarks() const;
  bool complete() const { return count(RunState::done) == static_cast<Index>(runs.size()); }
};

/// The rows of a trials.csv as an outcome that is unfinished. Throws InvalidInput if it is none.
RunOutcome outcome_of(files::Table trials, Index planned_trials);

}  // namespace rehearse::campaign
