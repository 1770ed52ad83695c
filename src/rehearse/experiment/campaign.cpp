#include "rehearse/experiment/campaign.hpp"

#include <chrono>
#include <memory>
#include <mutex>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/experiment/campaign_folder.hpp"
#include "rehearse/experiment/run.hpp"

namespace rehearse::experiment {
namespace {

using Clock = std::chrono::steady_clock;

/// The state of a campaign, shared by the threads that work on it.
class Ledger {
 public:
  Ledger(const CampaignFolder& folder, Campaign& campaign, const CampaignOptions& options)
      : folder_(folder), campaign_(campaign), options_(options) {}

  bool stopped() const { return options_.stop && options_.stop(); }

  /// The next run to do, in the order of the plan.
  std::optional<std::size_t> next() {
    const std::lock_guard lock(mutex_);
    while (next_ < campaign_.runs.size() && campaign_.runs[next_].state != RunState::unfinished) ++next_;
    if (stopped() || next_ >= campaign_.runs.size()) return std::nullopt;
    return next_++;
  }

  template <class Tell>
  void tell(Tell tell) {
    const std::lock_guard lock(mutex_);
    if (options_.listener) tell(*options_.listener);
  }

  void update(std::size_t run, RunOutcome outcome) {
    const std::lock_guard lock(mutex_);
    campaign_.runs[run] = std::move(outcome);
    if (Clock::now() < next_write_) return;
    const auto begin = Clock::now();
    try {
      folder_.write(campaign_);
    } catch (const std::runtime_error&) {  // a full disk: the last write says so, if it still is
    }
    const auto end = Clock::now();
    next_write_ = end + std::max<Clock::duration>(std::chrono::seconds(1), 20 * (end - begin));
  }

 private:
  const CampaignFolder& folder_;
  Campaign& campaign_;
  const CampaignOptions& options_;
  std::mutex mutex_;
  std::size_t next_ = 0;
  Clock::time_point next_write_;
};

/// Passes on what one run says.
class Reporter final : public RunListener {
 public:
  Reporter(const CampaignFolder& folder, Ledger& ledger, const PlannedRun& planned, std::size_t run)
      : folder_(folder), ledger_(ledger), planned_(planned), run_(run) {}

  void started(const Resolved&, const std::filesystem::path&, Index done) override {
    ledger_.tell([&](CampaignListener& listener) { listener.run_started(run_, done); });
  }
  void progress(Index trial, const Progress& progress) override {
    ledger_.tell([&](CampaignListener& listener) { listener.progress(run_, trial, progress); });
  }
  void trial_done(const TrialRecord& record) override {
    if (record.trial < planned_.spec.trials) ledger_.update(run_, folder_.read(planned_));
  }

 private:
  const CampaignFolder& folder_;
  Ledger& ledger_;
  const PlannedRun& planned_;
  std::size_t run_;
};

/// The threads that do the runs.
class Crew {
 public:
  Crew(const Catalogue& catalogue, const CampaignFolder& folder, const Campaign& campaign, Ledger& ledger)
      : catalogue_(catalogue), folder_(folder), campaign_(campaign), ledger_(ledger) {}

  /// Runs at once; each with its share of the threads if there are more of these.
  void work(Index workers, int threads) {
    std::vector<std::shared_ptr<const Evaluator>> evaluators;
    for (Index i = 0; i < workers; ++i) {
      const int share = threads / static_cast<int>(workers) + (i < threads % workers);
      evaluators.push_back(make_thread_evaluator(share));
    }
    make_thread_evaluator(static_cast<int>(workers))->for_each(workers, [&](Index i) {
      while (const auto run = ledger_.next()) do_run(*run, evaluators[static_cast<std::size_t>(i)]);
    });
  }

 private:
  void do_run(std::size_t index, const std::shared_ptr<const Evaluator>& evaluator) {
    const PlannedRun& planned = campaign_.plan.runs[index];
    Reporter reporter(folder_, ledger_, planned, index);
    const RunOptions options{
        .evaluator = evaluator, .listener = &reporter, .stop = [this] { return ledger_.stopped(); }};
    const RunOutcome outcome = outcome_of_run(planned, options);
    ledger_.update(index, outcome);
    if (outcome.state != RunState::unfinished)
      ledger_.tell([&](CampaignListener& listener) { listener.run_ended(index, outcome); });
  }

  RunOutcome outcome_of_run(const PlannedRun& planned, const RunOptions& options) const {
    RunOutcome outcome;
    try {
      start_or_resume(planned, options);
      return folder_.read(planned);
    } catch (const Interrupted&) {
      return folder_.read(planned);
    } catch (const InvalidInput& error) {  // a damaged folder: its rows cannot be trusted
      outcome.fail(error.what());
    } catch (const std::exception& error) {
      outcome = folder_.read(planned);
      outcome.fail(error.what());
    }
    return outcome;
  }

  void start_or_resume(const PlannedRun& planned, const RunOptions& options) const {
    const auto path = folder_.path_of(planned);
    if (std::filesystem::exists(path))
      resume_run(catalogue_, path, planned.spec.trials, options);
    else
      start_run(catalogue_, planned.spec, path, options);
  }

  const Catalogue& catalogue_;
  const CampaignFolder& folder_;
  const Campaign& campaign_;
  Ledger& ledger_;
};

}  // namespace

Campaign run_campaign(const Catalogue& catalogue, std::string_view text, const std::string& source,
                      const std::filesystem::path& path, const CampaignOptions& options) {
  Campaign campaign{.plan = plan_campaign(catalogue, text, source)};
  const CampaignFolder folder = CampaignFolder::open(catalogue, path, text, campaign.plan);
  for (const PlannedRun& run : campaign.plan.runs) campaign.runs.push_back(folder.read(run));
  campaign.skipped = folder.strangers(campaign.plan);
  folder.write(campaign);

  Ledger ledger(folder, campaign, options);
  const int threads = options.threads > 0 ? options.threads : make_thread_evaluator(0)->concurrency();
  const Index workers = std::min<Index>(threads, campaign.count(RunState::unfinished));
  ledger.tell([&](CampaignListener& listener) { listener.started(campaign, workers); });
  if (workers > 0) Crew(catalogue, folder, campaign, ledger).work(workers, threads);
  folder.write(campaign);
  return campaign;
}

}  // namespace rehearse::experiment
