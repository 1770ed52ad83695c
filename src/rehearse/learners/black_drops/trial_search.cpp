#include "rehearse/learners/black_drops/trial_search.hpp"

namespace rehearse::learners::black_drops {
namespace {

Choice choice_of(const SearchResult& found) { return {found.theta, found.predicted_return}; }

/// On the prior, before there are data.
Choice search_prior(TrialSearches& searches, const Known& known, const Options& options) {
  std::vector<Vector> starts = known.policies;
  SearchResult found;
  for (Index i = 0; i < options.prior_searches; ++i) {
    found = searches.search(starts, i);
    starts = {found.theta};
  }
  Choice choice = choice_of(found);
  const auto again = [&](Index i) { return searches.search({choice.theta}, options.prior_searches - 1 + i); };
  prefer_solving_where_sure(searches, found, again, options.retry, choice);
  return choice;
}

}  // namespace

Choice search_trial(TrialSearches& searches, const Known& known, const Options& options) {
  if (known.prior_alone) return search_prior(searches, known, options);
  const SearchResult found = searches.search(known.policies, 0);
  Choice choice = choice_of(found);
  prefer_solving_where_uncertain(searches, found, options.retry, choice);
  return choice;
}

}  // namespace rehearse::learners::black_drops
