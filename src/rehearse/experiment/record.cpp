#include "rehearse/experiment/record.hpp"

#include <algorithm>

namespace rehearse::experiment {

bool was_told(const History& history) {
  return !history.trials.empty() &&
         std::ranges::none_of(history.trials, [](const TrialRecord& t) { return t.file_checksum.empty(); });
}

const TrialRecord& best_trial(const std::vector<TrialRecord>& trials) {
  return *std::max_element(trials.begin(), trials.end(), [](const TrialRecord& a, const TrialRecord& b) {
    return a.cut_short || b.cut_short ? a.cut_short && !b.cut_short : a.total_reward < b.total_reward;
  });
}

}  // namespace rehearse::experiment
