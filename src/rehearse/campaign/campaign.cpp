#include "rehearse/campaign/campaign.hpp"

#include <future>
#include <memory>

#include <fmt/format.h>

#include "rehearse/campaign/folder.hpp"
#include "rehearse/campaign/ledger.hpp"
#include "rehearse/campaign/planner.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/experiment/run_folder.hpp"

namespace rehearse::campaign {
namespace {

constexpr const char *kOpen = "open the folder", *kStart = "start";  // steps of all ranks

/// Passes the events of one run on.
class Reporter final : public experiment::RunListener {
 public:
  Reporter(const CampaignFolder& folder, Ledger& ledger, const PlannedRun& planned, std::size_t run)
      : folder_(folder), ledger_(ledger), planned_(planned), run_(run) {}

  void started(const experiment::Resolved&, const std::filesystem::path&, Index done) override {
    ledger_.run_started(run_, done);
  }
  void progress(Index trial, const Progress& progress) override { ledger_.progress(run_, trial, progress); }
  void trial_done(const experiment::TrialRecord& record) override {
    if (!planned_.spec.ends_with(record.trial, record.solved.value_or(false)))  // or run_ended tells all
      ledger_.trial_done(run_, folder_.read(planned_));
  }

 private:
  const CampaignFolder& folder_;
  Ledger& ledger_;
  const PlannedRun& planned_;
  std::size_t run_;
};

/// The number of concurrent runs, here and in all, and of threads here.
struct Places {
  Index here = 0, in_all = 0;
  int threads = 1;
};

/// The threads that do the runs, of one process.
class Crew {
 public:
  Crew(const experiment::Catalogue& catalogue, const CampaignFolder& folder, const CampaignPlan& plan,
       const experiment::CacheFolder& cache, Ledger& ledger)
      : catalogue_(catalogue), folder_(folder), plan_(plan), cache_(cache), ledger_(ledger) {}

  /// Runs at once; each with its share of the threads if there are more of these.
  void work(const Places& places) {
    if (places.here == 0) return;
    std::vector<std::shared_ptr<const Evaluator>> evaluators;
    evaluators.reserve(static_cast<std::size_t>(places.here));
    const int workers = static_cast<int>(places.here);
    for (int i = 0; i < workers; ++i)
      evaluators.push_back(make_thread_evaluator(places.threads / workers + (i < places.threads % workers)));
    make_thread_evaluator(workers)->for_each(workers, [&](Index i) {
      while (const auto run = ledger_.next()) do_run(*run, evaluators[static_cast<std::size_t>(i)]);
    });
  }

 private:
  void do_run(std::size_t index, const std::shared_ptr<const Evaluator>& evaluator) {
    const PlannedRun& planned = plan_.runs[index];
    Reporter reporter(folder_, ledger_, planned, index);
    const experiment::RunOptions options{
        .evaluator = evaluator, .listener = &reporter, .stop = [this] { return ledger_.stopped(); }, .cache = cache_};
    ledger_.run_ended(index, outcome_of_run(planned, options));
  }

  /// Unfinished only after a stop.
  RunOutcome outcome_of_run(const PlannedRun& planned, const experiment::RunOptions& options) const {
    RunOutcome outcome;
    try {
      start_or_resume(planned, options);
      outcome = folder_.read(planned);
      if (outcome.state == RunState::unfinished)
        outcome.fail(fmt::format("{} does not show what was written to it", folder_.path_of(planned).string()));
    } catch (const Interrupted&) {
      outcome = folder_.read(planned);
    } catch (const InvalidInput& error) {
      if (is_sound(folder_.path_of(planned))) outcome = folder_.read(planned);  // another process uses it, perhaps
      outcome.fail(error.what());
    } catch (const std::exception& error) {
      outcome = folder_.read(planned);
      outcome.fail(error.what());
    }
    return outcome;
  }

  /// False: it is damaged, and its rows cannot be trusted.
  static bool is_sound(const std::filesystem::path& folder) {
    try {
      experiment::RunFolder::read(folder);
      return true;
    } catch (const InvalidInput&) {
      return false;
    }
  }

  void start_or_resume(const PlannedRun& planned, const experiment::RunOptions& options) const {
    const auto path = folder_.path_of(planned);
    if (std::filesystem::exists(path))
      experiment::resume_run(catalogue_, path, experiment::Until(planned.spec.trials, planned.spec.until_solved),
                             options);
    else
      experiment::start_run(catalogue_, planned.spec, path, options);
  }

  const experiment::Catalogue& catalogue_;
  const CampaignFolder& folder_;
  const CampaignPlan& plan_;
  const experiment::CacheFolder& cache_;
  Ledger& ledger_;
};

/// The places: one for each thread, but no more than runs; on every rank in proportion to its threads.
Places places_of(const CampaignOptions& options, Index runs) {
  Places places{.threads = options.threads > 0 ? options.threads : make_thread_evaluator(0)->concurrency()};
  const auto given = options.ranks ? options.ranks->exchange("threads", std::to_string(places.threads))
                                   : std::vector{std::to_string(places.threads)};
  Index all = 0, before = 0;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Index threads = std::stoi(given[i]);
    all += threads;
    if (options.ranks && static_cast<int>(i) < options.ranks->rank()) before += threads;
  }
  places.in_all = std::min(all, runs);
  places.here = places.in_all * (before + places.threads) / all - places.in_all * before / all;
  return places;
}

/// Leaves the plan the runs of a share.
void keep(const Share& share, CampaignPlan& plan) {
  std::vector<PlannedRun> own;
  for (auto i = static_cast<std::size_t>(share.number - 1); i < plan.runs.size();
       i += static_cast<std::size_t>(share.of))
    own.push_back(std::move(plan.runs[i]));
  plan.runs = std::move(own);
}

/// The other ranks' part of the work, while this one does its own.
class Answering {
 public:
  Answering(const CampaignOptions& options, OwnLedger& ledger) : ledger_(ledger) {
    if (options.ranks)
      done_ =
          std::async(std::launch::async, [&ranks = *options.ranks, &ledger] { answer_distant_ledgers(ranks, ledger); });
  }
  ~Answering() {
    if (done_.valid()) ledger_.stop();  // an exception is under way: they need not go on
  }
  Answering(const Answering&) = delete;
  Answering& operator=(const Answering&) = delete;
  void finish() {
    if (done_.valid()) done_.get();
  }

 private:
  OwnLedger& ledger_;
  std::future<void> done_;
};

/// Rank 0's part, or that of a process that is alone.
class Leader {
 public:
  Leader(const experiment::Catalogue& catalogue, CampaignPlan plan, const CampaignOptions& options)
      : catalogue_(catalogue), options_(options), campaign_{.plan = std::move(plan)} {}

  Campaign work(std::string_view text, const std::filesystem::path& path) {
    const std::string unfinished = once(kOpen, [&] {
      open_folder(text, path);
      return std::to_string(campaign_.count(RunState::unfinished));
    });
    const Places places = places_of(options_, std::stoi(unfinished));
    once(kStart, [&] {
      if (options_.listener) options_.listener->started(campaign_, places.in_all);
      return std::string();
    });
    OwnLedger ledger(*folder_, campaign_, options_);
    Answering answering(options_, ledger);
    Crew(catalogue_, *folder_, campaign_.plan, options_.cache, ledger).work(places);
    answering.finish();
    write_tables();
    return std::move(campaign_);
  }

 private:
  /// Does the work once for all ranks. A failure fails on all of them, which wait for it.
  std::string once(const char* step, const std::function<std::string()>& work) const {
    return options_.ranks ? options_.ranks->once(step, work) : work();
  }

  void open_folder(std::string_view text, const std::filesystem::path& path) {
    const bool whole = options_.share.of == 1;
    folder_.emplace(CampaignFolder::open(catalogue_, path, text, campaign_.plan,
                                         whole ? files::FolderLock::Kind::exclusive : files::FolderLock::Kind::shared));
    keep(options_.share, campaign_.plan);
    if (whole) {  // else others may be making theirs
      folder_->remove_abandoned(campaign_.plan);
      campaign_.skipped = folder_->strangers(campaign_.plan);
    }
    for (const PlannedRun& run : campaign_.plan.runs) campaign_.runs.push_back(folder_->read(run));
    write_tables();
  }

  void write_tables() const {
    if (options_.share.of == 1) folder_->write(campaign_);
  }

  const experiment::Catalogue& catalogue_;
  const CampaignOptions& options_;
  Campaign campaign_;
  std::optional<CampaignFolder> folder_;
};

/// The part of the other ranks.
void follow(const experiment::Catalogue& catalogue, CampaignPlan plan, std::string_view text,
            const std::filesystem::path& path, const CampaignOptions& options) {
  keep(options.share, plan);
  const std::string unfinished = options.ranks->once(kOpen, {});
  const CampaignFolder folder = CampaignFolder::join(path, text);
  const Places places = places_of(options, std::stoi(unfinished));
  options.ranks->once(kStart, {});  // until the listener knows of the campaign
  DistantLedger ledger(*options.ranks, options.stop);
  try {
    Crew(catalogue, folder, plan, options.cache, ledger).work(places);
  } catch (const std::exception& error) {
    ledger.close(fmt::format("rank {} failed: {}", options.ranks->rank(), error.what()));
    throw;
  } catch (...) {
    ledger.close(fmt::format("rank {} failed", options.ranks->rank()));
    throw;
  }
  ledger.close("");
}

}  // namespace

Campaign run_campaign(const experiment::Catalogue& catalogue, std::string_view text, const std::string& source,
                      const std::filesystem::path& path, const CampaignOptions& options) {
  const auto [number, of] = options.share;
  if (number < 1 || number > of)
    throw InvalidInput(fmt::format("share = {}/{}, must be K/N with K from 1 to N", number, of));
  CampaignPlan plan = plan_campaign(catalogue, text, source);
  if (!options.ranks || options.ranks->rank() == 0) return Leader(catalogue, std::move(plan), options).work(text, path);
  follow(catalogue, plan, text, path, options);
  return {.plan = std::move(plan)};
}

}  // namespace rehearse::campaign
