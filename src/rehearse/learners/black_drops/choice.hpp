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
  double solving = 0;                 // the same as in SearchResult, where that decided
  bool none_solves = false;           // policies were looked for that solve the task, and none was found that ever does

  void take(const SearchResult& found) {
    theta = found.theta, predicted_return = found.predicted_return;
    risks = found.risks, excess = found.excess, solving = found.solving;
  }
};

/// True if the choice solves the task in simulated episodes often enough for a trial.
bool often_solves(const Choice& choice);

/// The note of a trial whose searches found no policy that solves the task in any simulated episode.
inline constexpr const char* kNoneSolves =
    "no policy that was found solves the task in a simulated episode: the goal may be out of reach of the model, or of "
    "the robot (docs/does-not-learn.md, steps 2 to 5)";

/// Runs the i-th further search, i = 1, 2, … best: the policy that solves the task most often so far, if one does, and
/// that of the highest return.
using SearchAgain = std::function<SearchResult(Index i, const std::vector<Vector>& best)>;

/// Searches for policies that keep the task's limits, where the choice keeps them too rarely or less safe policies
/// promise more: `safety.searches` times at most, near the best of all that `found` has. `found` becomes what the
/// search that made the choice has found. Nothing happens without limits.
void prefer_safe(TrialSearches& searches, const SafetyOptions& safety, SearchResult& found, Choice& choice);

/// Repeats searches, where the model is sure, until one finds a policy that is expected to solve the task for about the
/// highest return, `retry.searches` times at most. A policy that solves it becomes the choice at any cost in return,
/// but never if it is less safe. `found`: what the search that made the choice has found. Nothing happens where the
/// task has no test of success.
void prefer_solving_where_sure(TrialSearches& searches, const SearchResult& found, const SearchAgain& again,
                               const Retry& retry, Choice& choice);

/// Repeats searches from other points, where the model is sure and the task has no test of success, until one finds
/// about the highest return again, `retry.searches` times at most: a return that two searches agree on is hardly that
/// of a descent that was cut off. The policy of the highest return becomes the choice.
void prefer_found_again(TrialSearches& searches, const Retry& retry, Choice& choice);

/// Exchanges a policy that was tried, and is not expected to solve the task, for the best new one of its search,
/// however near. Where the model is sure of the old one, its trial would teach nothing, so a new one may cost anything;
/// else `retry.uncertain_tolerance` of the return.
void prefer_new(TrialSearches& searches, const std::vector<Vector>& tried, const SearchResult& found,
                const Retry& retry, Choice& choice);

/// Gives up a little of the return (`retry.uncertain_tolerance`), where the model is uncertain, for the policy that
/// most often solves the task. Where none does so nearly always, searches go on in which an episode that solves the
/// task is worth as much again.
void prefer_solving_where_uncertain(TrialSearches& searches, const SearchResult& found, const Retry& retry,
                                    Choice& choice);

}  // namespace rehearse::learners::black_drops
