#include "rehearse/learners/black_drops/trial_search.hpp"

namespace rehearse::learners::black_drops {
namespace {

Choice choice_of(const SearchResult& found) {
  Choice choice;
  choice.take(found);
  return choice;
}

/// The search on the prior, before there are data.
Choice search_prior(TrialSearches& searches, const Known& known, const Options& options) {
  std::vector<Vector> starts = known.policies;
  SearchResult found;
  for (Index i = 0; i < options.prior_searches; ++i) {
    found = searches.search(starts, i);
    starts = {found.theta};
  }
  Choice choice = choice_of(found);
  prefer_safe(searches, options.search.safety, found, choice);
  const auto again = [&](Index i) { return searches.search({choice.theta}, options.prior_searches - 1 + i); };
  prefer_solving_where_sure(searches, found, again, options.retry, choice);
  return choice;
}

Choice search_with_data(TrialSearches& searches, const Known& known, const Options& options) {
  SearchResult found = searches.search(known.policies, 0);
  Choice choice = choice_of(found);
  prefer_safe(searches, options.search.safety, found, choice);
  prefer_solving_where_uncertain(searches, found, options.retry, choice);
  return choice;
}

}  // namespace

Choice search_trial(TrialSearches& searches, const Known& known, const Options& options) {
  Choice choice =
      known.prior_alone ? search_prior(searches, known, options) : search_with_data(searches, known, options);
  if (!searches.has_limits()) return choice;
  const SearchResult judged = searches.judge(choice.theta);  // in episodes that did not decide
  choice.risks = judged.risks;
  choice.excess = judged.excess;
  return choice;
}

}  // namespace rehearse::learners::black_drops
