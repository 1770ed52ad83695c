#pragma once

#include "rehearse/core/episode.hpp"
#include "rehearse/experiment/record.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::experiment {

/// The record of a trial: the proposal that was tried and what came of it. `interaction_s` is left to who knows the
/// trials before.
TrialRecord record_of(Index trial, const learners::Proposal& proposal, const Episode& episode,
                      const Resolved& resolved);

}  // namespace rehearse::experiment
