#pragma once
// Comparisons of an episode's actions with those of a policy, for the sources of this room.

#include <string>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/experiment/trial_record.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::experiment {

/// An episode that was read from a file. off: how far its control steps are from the file's rows, as a part of a step:
/// a loop with a clock of its own computes its actions so much before or after the states here.
struct ReadEpisode {
  const Episode& episode;
  double off = 0;
};

/// Root mean square differences (du) of the actions from those of a trial's policy in the measured states, or from what
/// is between them and, at `off`, those of the steps before and after.
Vector deviations(const ReadEpisode& read, const scenario::Scenario& scenario, const TrialRecord& trial);

/// The largest of them, as a part of its action's range; infinite where there is no step to compare.
double largest_deviation(const ReadEpisode& read, const scenario::Scenario& scenario, const TrialRecord& trial);

/// True if the actions are those of a trial's policy, as exactly as motors are.
bool has_actions_of(const ReadEpisode& read, const scenario::Scenario& scenario, const TrialRecord& trial);

/// A sentence for each action that was not the policy's of the trial that was asked for. They end with what would
/// explain it: the policy of an earlier trial, another unit or sign of a state or an action, or rows that are a step
/// apart; else with what it may be.
std::vector<std::string> sentences_on_policy(const ReadEpisode& read, const scenario::Scenario& scenario,
                                             const TrialRecord& asked, const std::vector<TrialRecord>& earlier);

}  // namespace rehearse::experiment
