#include "rehearse/experiment/record.hpp"

#include <algorithm>
#include <cmath>

namespace rehearse::experiment {

double seconds(Index steps, double dt_s) { return std::round(static_cast<double>(steps) * dt_s * 1e9) / 1e9; }

const TrialRecord& best_trial(const std::vector<TrialRecord>& trials) {
  return *std::max_element(trials.begin(), trials.end(),
                           [](const TrialRecord& a, const TrialRecord& b) { return a.total_reward < b.total_reward; });
}

}  // namespace rehearse::experiment
