#pragma once
// Random actions: for the first trial without a prior, and where no safe policy promises more than was earned.

#include "rehearse/learners/black_drops/options.hpp"

namespace rehearse::learners::black_drops {

/// θ of a schedule (policy/schedule.hpp) of random actions.
Vector random_actions(const Task& task, const FirstTrial& options, const StreamKey& key);

/// The same schedule with each action at a fraction of its way from the middle of its range.
Vector smaller_actions(const Task& task, Vector schedule, double fraction);

/// Random actions, as large as the task's limits allow in the model; its excess is not 0 where even small ones are not
/// safe. It counts all rollouts. problem: with a schedule as its policy. trial: the stream of the trial.
SearchResult safe_random_actions(const SearchProblem& problem, const Options& options, const StreamKey& trial);

}  // namespace rehearse::learners::black_drops
