#pragma once
// Random actions: for the first trial without a prior, and where no safe policy promises more than was earned.

#include <optional>

#include "rehearse/learners/black_drops/options.hpp"

namespace rehearse::learners::black_drops {

/// θ of a schedule (policy/schedule.hpp) of random actions, each this fraction of its way from the middle of its range.
Vector random_actions(const Task& task, const FirstTrial& options, double fraction, const StreamKey& key);

/// Random actions, as large as the task's limits allow in the model; empty where even small ones are not safe.
/// problem: with a schedule as its policy. trial: the stream of the trial.
std::optional<SearchResult> safe_random_actions(const SearchProblem& problem, const Options& options,
                                                const StreamKey& trial);

}  // namespace rehearse::learners::black_drops
