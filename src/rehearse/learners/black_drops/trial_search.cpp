#include "rehearse/learners/black_drops/trial_search.hpp"

namespace rehearse::learners::black_drops {
namespace {

Choice choice_of(const SearchResult& found) {
  Choice choice;
  choice.take(found);
  return choice;
}

/// The search on the prior, before there are data.
Choice search_prior(TrialSearches& searches, const Known& known, const Options& options, SearchResult& found) {
  std::vector<Vector> starts = known.starts;
  for (Index i = 0; i < options.prior_searches; ++i) {
    found = searches.search(starts, i);
    starts = {found.theta};
  }
  Choice choice = choice_of(found);
  prefer_safe(searches, options.search.safety, found, choice);
  const auto again = [&](Index i, const std::vector<Vector>& best) {
    return searches.search({best.back()}, options.prior_searches - 1 + i);
  };
  prefer_solving_where_sure(searches, found, again, options.retry, choice);
  return choice;
}

Choice search_with_data(TrialSearches& searches, const Known& known, const Options& options, SearchResult& found) {
  found = searches.search(known.starts, 0);
  Choice choice = choice_of(found);
  prefer_safe(searches, options.search.safety, found, choice);
  prefer_solving_where_uncertain(searches, found, options.retry, choice);
  prefer_new(searches, known.tried, found, options.retry, choice);
  prefer_found_again(searches, options.retry, choice);
  return choice;
}

/// Exchanges the choice for a policy that is as good in the trial and lasts longer. found: by the searches that made
/// the choice; half of the descents begin there.
void prefer_lasting(TrialSearches& searches, TrialSearches& longer, const SearchResult& found, const Options& options,
                    Choice& choice) {
  std::vector<Vector> starts = {choice.theta};
  for (const Vector& other : found.runners_up)
    if (static_cast<Index>(2 * starts.size()) < options.search.race.descents) starts.push_back(other);
  const SearchResult further = longer.search(starts, 0);
  Choice lasting = choice_of(further);
  const auto again = [&](Index i, const std::vector<Vector>& best) {
    starts.front() = best.back();
    return longer.search(starts, i);
  };
  prefer_solving_where_sure(longer, further, again, options.retry, lasting);
  SearchResult judged = searches.judge(lasting.theta);
  if (judged.excess > choice.excess) return;
  const Vector solving = searches.compare_solving({judged.theta, choice.theta});
  judged.solving = solving(0);
  const bool as_often = solving(0) >= solving(1);
  const bool as_well =
      solving(1) > 0 || within(options.retry.tolerance, choice.predicted_return, judged.predicted_return);
  if (as_often && as_well) choice.take(judged);
}

}  // namespace

Choice search_trial(TrialSearches& searches, TrialSearches* longer, const Known& known, const Options& options) {
  SearchResult found;
  Choice choice = known.prior_alone ? search_prior(searches, known, options, found)
                                    : search_with_data(searches, known, options, found);
  if (longer) prefer_lasting(searches, *longer, found, options, choice);
  if (!searches.has_limits()) return choice;
  const SearchResult judged = searches.judge_anew(choice.theta);
  choice.risks = judged.risks;
  choice.excess = judged.excess;
  choice.solving = judged.solving;
  return choice;
}

}  // namespace rehearse::learners::black_drops
