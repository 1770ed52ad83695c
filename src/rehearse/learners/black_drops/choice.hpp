#pragma once

#include <functional>

#include "rehearse/learners/black_drops/options.hpp"
#include "rehearse/learners/black_drops/trial_searches.hpp"

namespace rehearse::learners::black_drops {

/// The policy of a trial.
struct Choice {
  Vector theta;
  double predicted_return = 0;
  std::vector<LimitRisk> risks = {};  // one a limit of the task
  double excess = 0;                  // of these over what is allowed; 0: it is safe
  double solving = 0;                 // how surely it solves the task, where that decided

  void take(const SearchResult& found) {
    theta = found.theta, predicted_return = found.predicted_return;
    risks = found.risks, excess = found.excess, solving = found.solving;
  }
};

/// Whether the choice solves the task in simulated episodes as often as is enough for a trial.
bool often_solves(const Choice& choice);

/// The i-th search more, i = 1, 2, …
using SearchAgain = std::function<SearchResult(Index i)>;

/// Searches for policies that keep the task's limits, where the choice keeps them too rarely or less safe policies
/// promise more: `safety.searches` times at most, near the best of all that `found` has. `found` becomes what the
/// search that made the choice has found. Nothing happens without limits.
void prefer_safe(TrialSearches& searches, const SafetyOptions& safety, SearchResult& found, Choice& choice);

/// Repeats searches, where the model is sure, until one finds a policy that is expected to solve the task for about the
/// highest return, `retry.searches` times at most. A policy that solves it becomes the choice, whatever it costs but a
/// limit kept less often.
/// `found`: what the search that made the choice has found. Nothing happens where the task cannot say what solves it.
void prefer_solving_where_sure(TrialSearches& searches, const SearchResult& found, const SearchAgain& again,
                               const Retry& retry, Choice& choice);

/// Gives up a little of the return (`retry.uncertain_tolerance`), where the model is uncertain, for the policy that
/// most often solves the task. Where none does so in half of the episodes, searches go on in the means.
void prefer_solving_where_uncertain(TrialSearches& searches, const SearchResult& found, const Retry& retry,
                                    Choice& choice);

}  // namespace rehearse::learners::black_drops
