#pragma once

#include <functional>
#include <string>
#include <vector>

#include "rehearse/learners/learner.hpp"

namespace rehearse::testing {

/// One trial of the policy proposed; the same episode for the same policy, θ and trial (1, 2, …).
using RunTrial = std::function<Episode(const learners::Proposal& proposal, std::uint64_t trial)>;

/// The laws of a learner, tried on `trials` trials. Returns a line for each law that is broken:
///
/// - a proposal has a policy, and as many parameters as that takes;
/// - `ask` is idempotent: until the next `tell` it returns the same proposal;
/// - the same bytes on one and on two threads;
/// - a learner that loads what was saved after any episode, as text, goes on with the same proposals and tables;
/// - one that is given θ again goes on in the same way;
/// - one that takes logs of other controllers goes on with them when it is loaded;
/// - a table has a name for each of its columns.
///
/// The setting's evaluator is ignored. About trials² / 2 + 2 trials proposals are computed: give it a small budget.
std::vector<std::string> check_learner(const learners::LearnerBuilder& builder, const learners::Setting& setting,
                                       const RunTrial& run_trial, Index trials = 3);

}  // namespace rehearse::testing
