#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "rehearse/campaign/folder.hpp"
#include "rehearse/campaign/options.hpp"
#include "rehearse/core/ranks.hpp"

namespace rehearse::campaign {

/// Gives out the runs of a campaign, says when to stop, and is told how the runs go. Thread-safe.
class Ledger {
 public:
  virtual ~Ledger() = default;
  virtual bool stopped() const = 0;
  virtual std::optional<std::size_t> next() = 0;  // the next run to do, in the order of the plan
  virtual void run_started(std::size_t run, Index trials_done) = 0;
  virtual void progress(std::size_t run, Index trial, const Progress& progress) = 0;
  virtual void trial_done(std::size_t run, RunOutcome so_far) = 0;
  virtual void run_ended(std::size_t run, RunOutcome outcome) = 0;  // or was stopped
};

/// The ledger itself: the state of a campaign, its tables and its listener.
class OwnLedger final : public Ledger {
 public:
  OwnLedger(const CampaignFolder& folder, Campaign& campaign, const CampaignOptions& options)
      : folder_(folder), campaign_(campaign), options_(options) {}

  bool stopped() const override { return stopped_ || (options_.stop && options_.stop()); }
  void stop() { stopped_ = true; }
  std::optional<std::size_t> next() override;
  void run_started(std::size_t run, Index trials_done) override;
  void progress(std::size_t run, Index trial, const Progress& progress) override;
  void trial_done(std::size_t run, RunOutcome so_far) override;
  void run_ended(std::size_t run, RunOutcome outcome) override;

 private:
  using Clock = std::chrono::steady_clock;

  template <class Tell>
  void tell(Tell tell);
  void update(std::size_t run, RunOutcome outcome);
  void write_if_due();

  const CampaignFolder& folder_;
  Campaign& campaign_;
  const CampaignOptions& options_;
  std::mutex mutex_;
  std::atomic<bool> stopped_ = false;
  std::size_t next_ = 0;
  bool written_ = true;  // the tables have all that is known
  Clock::time_point next_write_;
};

/// The ledger of rank 0 as another rank has it. Outcomes travel, not only the news of them: on network file systems one
/// machine may see for a minute what another has replaced.
class DistantLedger final : public Ledger {
 public:
  DistantLedger(Ranks& ranks, std::function<bool()> stop) : ranks_(ranks), stop_(std::move(stop)) {}

  bool stopped() const override { return stopped_ || (stop_ && stop_()); }
  std::optional<std::size_t> next() override;
  void run_started(std::size_t run, Index trials_done) override;
  void progress(std::size_t run, Index trial, const Progress& progress) override;
  void trial_done(std::size_t run, RunOutcome so_far) override;
  void run_ended(std::size_t run, RunOutcome outcome) override;

  /// Says that this rank asks no more. failure: empty if all is well; else why, and everybody stops.
  void close(const std::string& failure);

 private:
  using Clock = std::chrono::steady_clock;

  nlohmann::json ask(const nlohmann::json& question);

  Ranks& ranks_;
  std::function<bool()> stop_;
  std::atomic<bool> stopped_ = false;
  std::atomic<Clock::time_point> next_progress_{};
};

/// On rank 0: answers the distant ledgers until all of them are closed. An exception of the listener, or the failure of
/// a rank, stops everybody, and is thrown at the end.
void answer_distant_ledgers(Ranks& ranks, OwnLedger& ledger);

}  // namespace rehearse::campaign
