#pragma once

#include <functional>

#include "rehearse/campaign/results.hpp"
#include "rehearse/campaign/share.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/core/ranks.hpp"
#include "rehearse/experiment/run_store.hpp"

namespace rehearse::campaign {

/// Hears how a campaign goes; one call at a time, on whichever thread has the news. `run` is a position in the plan.
class CampaignListener {
 public:
  virtual ~CampaignListener() = default;
  virtual void started(const Campaign&, Index /*runs at once*/) {}
  virtual void run_started(std::size_t /*run*/, Index /*trials done before*/) {}
  virtual void progress(std::size_t /*run*/, Index /*trial*/, const Progress&) {}
  virtual void run_ended(std::size_t /*run*/, const RunOutcome&) {}
};

/// Settings that do not decide results.
struct CampaignOptions {
  int threads = 0;                       // in all, on this rank; 0: as many as cores
  CampaignListener* listener = nullptr;  // null: nobody listens
  std::function<bool()> stop;            // polled; once true, the campaign stops where it can be continued
  Share share;                           // other than 1 of 1: only these runs, and no tables
  experiment::CacheFolder cache;         // of what learners keep for other runs; null: none
  Ranks* ranks = nullptr;  // that share the runs, all with the same arguments; null: this process is alone
};

}  // namespace rehearse::campaign
