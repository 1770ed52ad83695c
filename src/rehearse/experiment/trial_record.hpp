#pragma once

#include "rehearse/core/episode.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/experiment/record.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::experiment {

/// The reason why rollouts of a search failed; there must be some.
std::string why_rollouts_failed(const learners::Proposal& proposal);

/// The record of a trial before it: the proposal.
TrialRecord record_before(Index trial, const learners::Proposal& proposal, const Resolved& resolved);

/// Adds the results of the episode. The caller sets `interaction_s`, which needs the trials before, and `forecast`,
/// which needs the model.
void add_outcome(TrialRecord& record, const Episode& episode, const Task& task);

}  // namespace rehearse::experiment
