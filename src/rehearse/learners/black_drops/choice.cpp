#include "rehearse/learners/black_drops/choice.hpp"

#include <optional>
#include <utility>

namespace rehearse::learners::black_drops {
namespace {

constexpr double kOften = 0.5;  // of the simulated episodes that a policy solves: enough for a trial

/// Searches until a policy is found that often solves the task, and whose predicted return is within a tolerance of the
/// highest one, which is the choice. Returns the policy that solves it most often, if one does.
std::optional<SearchResult> search_for_solving(TrialSearches& searches, SearchResult found, const SearchAgain& again,
                                               const Retry& limits, Choice& choice) {
  std::optional<SearchResult> solving;
  if (!searches.can_tell_solved()) return solving;
  for (Index i = 1;; ++i) {
    if (auto judged = searches.best_that_solves(found))
      if (!solving || judged->solving > solving->solving) solving = std::move(judged);
    if (solving && solving->solving >= kOften &&
        within(limits.tolerance, choice.predicted_return, solving->predicted_return))
      break;
    if (i > limits.searches) break;
    found = again(i);
    if (found.predicted_return > choice.predicted_return) choice.take(found);
  }
  return solving;
}

}  // namespace

void prefer_solving_where_sure(TrialSearches& searches, const SearchResult& found, const SearchAgain& again,
                               const Retry& retry, Choice& choice) {
  if (retry.searches == 0) return;
  if (const auto solving = search_for_solving(searches, found, again, retry, choice)) choice.take(*solving);
}

void prefer_solving_where_uncertain(TrialSearches& searches, const SearchResult& found, const Retry& retry,
                                    Choice& choice) {
  const double tolerance = retry.uncertain_tolerance;
  if (tolerance == 0) return;
  const auto again = [&](Index i) {
    SearchResult more = searches.search_means({choice.theta}, i);
    more.predicted_return = searches.judge(more.theta).predicted_return;
    return more;
  };
  Retry limits = retry;
  limits.tolerance = tolerance;
  const auto solving = search_for_solving(searches, found, again, limits, choice);
  if (solving && within(tolerance, choice.predicted_return, solving->predicted_return)) choice.take(*solving);
}

}  // namespace rehearse::learners::black_drops
