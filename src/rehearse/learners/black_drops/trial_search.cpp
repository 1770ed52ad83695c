#include "rehearse/learners/black_drops/trial_search.hpp"

#include <algorithm>
#include <cmath>

namespace rehearse::learners::black_drops {
namespace {

Chosen chosen_of(const SearchResult& found) { return {{found.theta, found.predicted_return}, found.runners_up}; }

/// On the prior, before there are data.
Chosen search_prior(TrialSearches& searches, const Known& known, const Options& options) {
  std::vector<Vector> starts = known.policies;
  SearchResult found;
  for (Index i = 0; i < options.prior_searches; ++i) {
    found = searches.search(starts, i);
    starts = {found.theta};
  }
  Chosen chosen = chosen_of(found);
  const auto again = [&](Index i) { return searches.search({chosen.choice.theta}, options.prior_searches - 1 + i); };
  prefer_solving_where_sure(searches, found, again, options.retry, chosen.choice);
  return chosen;
}

/// The choice of a search in the means, if the model's uncertainty costs its policy next to nothing.
std::optional<Chosen> choice_in_means(TrialSearches& searches, const SearchResult& means, const Options& options) {
  const SearchResult judged = searches.judge(means.theta);
  if (!within(options.mean_search.tolerance, means.predicted_return, judged.predicted_return)) return std::nullopt;
  Chosen chosen{{judged.theta, judged.predicted_return}, means.runners_up};
  const auto again = [&](Index i) { return searches.search_means({chosen.choice.theta}, i); };
  prefer_solving_where_sure(searches, means, again, options.retry, chosen.choice);
  return chosen;
}

/// The policies with those that a search in the means has found.
std::vector<Vector> with_best_of(std::vector<Vector> policies, const SearchResult& means, Index most) {
  policies.push_back(means.theta);
  const auto others = std::min(most - 1, static_cast<Index>(means.runners_up.size()));
  policies.insert(policies.end(), means.runners_up.begin(), means.runners_up.begin() + others);
  return policies;
}

/// Whether a predicted return exceeds the best one seen by a fraction of it.
bool gains(double predicted, double best, double fraction) { return predicted - best > fraction * std::abs(best); }

/// Takes the policy of a search in the means where the choice leads no further and the other does.
void explore(TrialSearches& searches, const Known& known, std::optional<SearchResult> means, const Options& options,
             Choice& choice) {
  const Exploration& explore = options.explore;
  if (explore.gain == 0 || !known.best_return) return;
  if (gains(choice.predicted_return, *known.best_return, explore.gain)) return;
  if (!means) means = searches.search_means(known.policies, 0);
  if (gains(means->predicted_return, *known.best_return, explore.required)) choice.take(*means);
}

}  // namespace

Chosen search_trial(TrialSearches& searches, const Known& known, const Options& options) {
  if (known.prior_alone) return search_prior(searches, known, options);
  const bool sampled = options.search.simulate.sample;
  std::vector<Vector> starts = known.policies;
  std::optional<SearchResult> means;
  if (options.mean_search.policies > 0 && sampled) {
    means = searches.search_means(starts, 0);
    if (auto chosen = choice_in_means(searches, *means, options)) return *chosen;
    starts = with_best_of(std::move(starts), *means, options.mean_search.policies);
  }
  SearchResult found = searches.search(starts, 0);
  Chosen chosen = chosen_of(found);
  if (means) {
    found.runners_up.push_back(means->theta);
    found.runners_up.insert(found.runners_up.end(), means->runners_up.begin(), means->runners_up.end());
  }
  prefer_solving_where_uncertain(searches, found, options.retry, chosen.choice);
  if (sampled) explore(searches, known, std::move(means), options, chosen.choice);
  return chosen;
}

}  // namespace rehearse::learners::black_drops
