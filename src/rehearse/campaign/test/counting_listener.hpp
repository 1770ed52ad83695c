#pragma once

#include "rehearse/campaign/campaign.hpp"

namespace rehearse::campaign {

/// Counts the events of a campaign whose runs have two trials.
class CountingListener final : public CampaignListener {
 public:
  Index at_once = -1, begun = 0, progressed = 0, ended = 0;
  void started(const Campaign&, Index runs) override { at_once = runs; }
  void run_started(std::size_t, Index) override { ++begun; }
  void progress(std::size_t, Index, const Progress&) override { ++progressed; }
  void run_ended(std::size_t, const RunOutcome& outcome) override { ended += outcome.done() == 2; }
};

}  // namespace rehearse::campaign
