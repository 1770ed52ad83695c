#pragma once

#include <vector>

#include "rehearse/core/random.hpp"
#include "rehearse/learners/black_drops/search_problem.hpp"

namespace rehearse::learners::black_drops {

struct SearchResult {
  Vector theta;
  double predicted_return = 0;
  double solving = 0;              // rate at which it solves the task (best_that_solves), where computed
  std::vector<LimitRisk> risks;    // one a limit of the task
  double excess = 0;               // of these over what the limits allow (safety.hpp); 0: it is safe
  double highest_return = 0;       // of all that were compared, safe or not
  std::vector<Vector> runners_up;  // other good policies, best first, safe or not
  Index rollouts = 0;
  Index failed_rollouts = 0;
};

/// True if `a` is to be chosen: the safer one, of equally safe ones that of the higher return.
bool better(const SearchResult& a, const SearchResult& b);

/// The policy of the highest expected return in the model, never worse there than `starts`, from which the first
/// descents begin; among those that keep the task's limits, or the safest if none does. `key` names the search: its
/// stage and number tell it from the others of its trial.
SearchResult search_policy(const SearchProblem& problem, const std::vector<Vector>& starts,
                           const SearchOptions& options, const StreamKey& key);

/// The expected return, and risks, of one policy, with the same random numbers for all policies that are judged with
/// one key.
SearchResult judge(const SearchProblem& problem, const Vector& theta, const SearchOptions& options,
                   const StreamKey& key);

struct SolvingRates {
  Vector rates;  // one a policy
  Index rollouts = 0;
  Index failed = 0;  // of these
};

/// The rate at which each policy solves the task in simulated episodes, the same for all policies; 0 if the task has no
/// test of success.
SolvingRates solving_rates(const SearchProblem& problem, const std::vector<Vector>& policies,
                           const SearchOptions& options, const StreamKey& key);

/// The interval in which every number of θ is searched.
Interval interval_of(const policy::Policy& policy, const SearchOptions& options);

/// θ uniform in the box.
Vector random_policy(const policy::Policy& policy, const SearchOptions& options, StreamKey key);

}  // namespace rehearse::learners::black_drops
