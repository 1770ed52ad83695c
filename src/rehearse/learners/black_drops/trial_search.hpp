#pragma once
// The search of one trial: policies that are known → search in the model's uncertainty → choice.

#include <vector>

#include "rehearse/learners/black_drops/choice.hpp"
#include "rehearse/learners/black_drops/options.hpp"

namespace rehearse::learners::black_drops {

/// Knowledge from before the search.
struct Known {
  std::vector<Vector> starts;  // of descents
  std::vector<Vector> tried;   // in the trials so far
  bool prior_alone = false;    // no data: the model is the prior alone
};

/// Chooses the policy of a trial: the best of those that keep the task's limits, the safest where none does. References
/// must outlive the call. longer: searches in episodes that go on after a trial's end; a policy that they find is the
/// choice if it does as well in the trial. Null: none.
Choice search_trial(TrialSearches& searches, TrialSearches* longer, const Known& known, const Options& options);

}  // namespace rehearse::learners::black_drops
