#pragma once

#include <optional>

#include "rehearse/experiment/past_run.hpp"
#include "rehearse/policy/exported.hpp"

namespace rehearse::experiment {

/// The policy of a trial of a run, or of the best one, to be taken along: with what it answers in states that the robot
/// was in during that trial, or before it if the trial is asked for. Throws InvalidInput if there is no such trial, or
/// its policy cannot be described.
policy::Exported exported_policy(const PastRun& run, std::optional<Index> trial = {});

/// The same of a trial that was asked for. like: an episode in whose states it is asked; null: the start is all.
policy::Exported exported_policy(const Resolved& resolved, const TrialRecord& asked, const Episode* like);

/// An episode of a run, in whose states such a policy may be asked: the last one, or a log; null before there are any.
const Episode* an_episode(const History& history);

}  // namespace rehearse::experiment
