#pragma once

#include "rehearse/core/episode.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/experiment/record.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::experiment {

/// The record of a trial before it: the proposal.
TrialRecord record_before(Index trial, const learners::Proposal& proposal, const Resolved& resolved);

/// Adds what the episode says. `interaction_s` is left to who knows the trials before, `forecast` to who has the model.
void add_outcome(TrialRecord& record, const Episode& episode, const Task& task);

}  // namespace rehearse::experiment
