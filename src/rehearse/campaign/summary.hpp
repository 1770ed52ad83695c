#pragma once
// The outcome of a campaign, as numbers and as the text of its two tables (docs/campaigns.md).

#include <optional>
#include <string>

#include "rehearse/campaign/results.hpp"
#include "rehearse/statistics/intervals.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::campaign {

/// Statistics of one trial, over the runs of a group.
struct TrialStatistics {
  Index trial = 0;
  Index runs = 0;            // that count at this trial
  double interaction_s = 0;  // median of the runs that did this trial; NaN if none did
  statistics::FiveNumbers total_reward, best_return;
  // In this trial; in this or one before; of the runs that count, and those that failed before it, which count
  // as not solved. Empty: the scenario cannot say.
  std::optional<statistics::Rate> solved, solved_by;
};

/// One entry for every trial that a run of the group has reached, or never will, since it failed.
std::vector<TrialStatistics> trial_statistics(const Campaign& campaign, std::size_t group);

/// One row a trial of every run, in the order of the plan.
std::string campaign_csv(const Campaign& campaign);

std::string summary_json(const Campaign& campaign);

}  // namespace rehearse::campaign
