#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/status_line.hpp"
#include "rehearse/campaign/campaign.hpp"

namespace rehearse::apps {

/// Shows a campaign on standard output: one line a run that ends, and a status line.
class CampaignConsole final : public campaign::CampaignListener {
 public:
  CampaignConsole(std::string folder, campaign::Share share) : folder_(std::move(folder)), share_(share) {}
  void started(const campaign::Campaign& campaign, Index at_once) override;
  void run_started(std::size_t run, Index done) override;
  void progress(std::size_t run, Index trial, const Progress& progress) override;
  void run_ended(std::size_t run, const campaign::RunOutcome& outcome) override;

  /// Prints the tables of results and claims; for a share, the runs that failed.
  void finished(const campaign::Campaign& campaign);
  void clear_line() { line_.clear(); }

 private:
  using Clock = std::chrono::steady_clock;

  struct Running {
    Clock::time_point begin, trial_begin;
    Index before = 0;  // trials done when it was started or continued
    Index trial = 1;
  };

  /// The cost of trials so far.
  struct Cost {
    double seconds = 0;
    Index trials = 0;
  };

  std::string name_of(std::size_t run) const;
  std::string kind_of(std::size_t run) const;  // its learner and variant
  std::map<std::string, Cost> costs() const;
  std::optional<double> seconds_left() const;

  StatusLine line_;
  std::string folder_;
  campaign::Share share_;
  campaign::CampaignPlan plan_;
  Index at_once_ = 1;
  Index ended_ = 0;
  Index failed_ = 0;
  std::map<std::size_t, Running> running_;
  std::vector<Index> left_;            // trials to do, by run
  std::map<std::string, Cost> spent_;  // in runs that have ended
};

/// Prints the runs that a campaign would do.
void print_plan(const campaign::CampaignPlan& plan);

}  // namespace rehearse::apps
