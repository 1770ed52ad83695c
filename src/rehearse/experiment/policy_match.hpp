#pragma once
// Comparisons of an episode's actions with those of a policy, for the sources of this room.

#include <string>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/experiment/trial_record.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::experiment {

/// Root mean square differences (du) of the actions from those of a trial's policy in the measured states.
Vector deviations(const Episode& episode, const scenario::Scenario& scenario, const TrialRecord& trial);

/// The largest of them, as a part of its action's range; infinite where there is no step to compare.
double largest_deviation(const Episode& episode, const scenario::Scenario& scenario, const TrialRecord& trial);

/// A sentence for each action that was not the policy's of the trial that was asked for. They end with what would
/// explain it: the policy of an earlier trial, another unit or sign of a state or an action, or rows that are a step
/// apart; else with what it may be.
std::vector<std::string> sentences_on_policy(const Episode& episode, const scenario::Scenario& scenario,
                                             const TrialRecord& asked, const std::vector<TrialRecord>& earlier);

}  // namespace rehearse::experiment
