// Runs and campaigns on several ranks, which here are threads.
#include "rehearse/core/ranks.hpp"

#include <atomic>
#include <mutex>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "counting_listener.hpp"
#include "fake.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/campaign.hpp"
#include "rehearse/experiment/files.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/testing/rank_threads.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

Spec line_spec(Index trials) { return {.scenario = "line", .learner = "echo", .trials = trials, .seed = 3}; }

std::string run_results(const fs::path& folder) {
  std::string bytes;
  for (const std::string name : {"spec.toml", "trials.csv", "errors.csv", "policy.json", "done",
                                 "trajectories/trial-001.csv", "predictions/trial-002.csv"})
    bytes += name + "\n" + read_file(folder / name);
  return bytes;
}

/// How a piece of work ends on each of three ranks.
class Ends {
 public:
  explicit Ends(const std::function<void(Ranks&, const RunOptions&)>& work,
                const std::function<bool(int rank)>& stop = {}) {
    testing::on_rank_threads(
        3, [&](Ranks& ranks) { add(end_of([&] { work(ranks, options(ranks)); })), ranks.leave(0, ""); }, stop);
  }
  /// What all ranks say, or how they differ.
  std::string all() const {
    std::string text;
    for (const std::string& word : words_) text += (text.empty() ? "" : " | ") + word;
    return text;
  }

 private:
  static RunOptions options(Ranks& ranks) {
    return {.evaluator = make_rank_evaluator(ranks, 1), .stop = [&] { return ranks.stopped(); }};
  }
  static std::string end_of(const std::function<void()>& work) {
    try {
      work();
    } catch (const std::exception& error) {
      return error.what();
    } catch (const Interrupted&) {
      return "interrupted";
    }
    return "done";
  }
  void add(const std::string& word) {
    const std::lock_guard lock(mutex_);
    words_.insert(word);
  }

  std::mutex mutex_;
  std::set<std::string> words_;
};

/// The catalogue, in which the plants that are made are counted.
Catalogue counting_catalogue(std::atomic<int>& plants) {
  return fake::catalogue_with([&plants](fake::MakePlant make) { return [&plants, make] { return ++plants, make(); }; });
}

TEST(RunOnRanks, SameBytesAndOnePlant) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(4), folder / "alone", {});
  std::atomic<int> plants{0};
  const Catalogue catalogue = counting_catalogue(plants);
  const Ends ends([&](Ranks&, const RunOptions& options) {
    EXPECT_EQ(start_run(catalogue, line_spec(4), folder / "ranks", options).trials, 4);
  });
  EXPECT_EQ(ends.all(), "done");
  EXPECT_EQ(plants, 1);
  EXPECT_EQ(run_results(folder / "ranks"), run_results(folder / "alone"));
}

TEST(RunOnRanks, StoppedAnywhereAndResumed) {
  const fs::path folder = fake::test_folder();
  Spec spec = line_spec(4);
  spec.options = {{"evaluations", "2"}};
  start_run(fake::catalogue(), spec, folder / "alone", {});
  int interrupted = 0;
  for (int stops = 0; stops < 30; stops += 3) {
    const fs::path run = folder / std::to_string(stops);
    std::atomic<int> polls{0};
    const Ends first([&](Ranks&, const RunOptions& options) { start_run(fake::catalogue(), spec, run, options); },
                     [&](int rank) { return rank == 1 && polls++ == stops; });
    interrupted += first.all() == "interrupted";
    EXPECT_TRUE(first.all() == "interrupted" || first.all() == "done") << first.all();
    const Ends second([&](Ranks&, const RunOptions& options) {
      if (fs::exists(run / "spec.toml")) resume_run(fake::catalogue(), run, {}, options);
    });
    EXPECT_EQ(second.all(), "done");
    EXPECT_EQ(run_results(run), run_results(folder / "alone")) << stops;
  }
  EXPECT_GE(interrupted, 5);
}

TEST(RunOnRanks, ExtendedByOtherNumbersOfRanks) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(4), folder / "alone", {});
  start_run(fake::catalogue(), line_spec(2), folder / "ranks", {});
  const Ends ends([&](Ranks&, const RunOptions& options) {
    EXPECT_EQ(resume_run(fake::catalogue(), folder / "ranks", 4, options).trials, 4);
  });
  EXPECT_EQ(ends.all(), "done");
  EXPECT_EQ(run_results(folder / "ranks"), run_results(folder / "alone"));
}

TEST(RunOnRanks, WhatFailsOnTheFirstFailsOnAll) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(1), folder / "there", {});
  const Ends exists([&](Ranks&, const RunOptions& options) {
    start_run(fake::catalogue(), line_spec(1), folder / "there", options);
  });
  EXPECT_TRUE(exists.all().starts_with((folder / "there").string() + " already exists")) << exists.all();
  EXPECT_EQ(exists.all().find(" | "), std::string::npos);

  Spec breaks = line_spec(8);
  breaks.options = {{"breaks", "true"}};
  const Ends broken([&](Ranks&, const RunOptions& options) {
    EXPECT_THROW(
        try { start_run(fake::catalogue(), breaks, folder / "breaks", options); } catch (const RunFailed& error) {
          EXPECT_NE(std::string(error.what()).find("the plant failed: the wheel came off"), std::string::npos);
          throw;
        },
        RunFailed);
  });
  EXPECT_EQ(broken.all(), "done");
}

TEST(RunOnRanks, ARankThatComesToAnotherPolicyEndsTheRun) {
  const fs::path folder = fake::test_folder();
  const Ends ends([&](Ranks& ranks, const RunOptions& options) {
    Spec spec = line_spec(3);
    if (ranks.rank() == 2) spec.options = {{"search.step", "0.40000000000000013"}};
    try {
      start_run(fake::catalogue(), spec, folder / "run", options);
    } catch (const std::exception& error) {
      ranks.leave(1, error.what());
      throw;
    }
  });
  EXPECT_NE(ends.all().find("it proposes another policy than that of rank 0"), std::string::npos) << ends.all();
  EXPECT_NE(ends.all().find("rank 2 failed"), std::string::npos) << ends.all();
}

const std::string kGrid =
    "format = 1\nscenario = \"line\"\nlearners = [\"echo\", \"echo-alone\", \"pilco\"]\n"
    "priors = [\"near\", \"far\"]\nseeds = \"1-3\"\ntrials = 2\n";

std::string campaign_results(const fs::path& folder) {
  return read_file(folder / "campaign.csv") + read_file(folder / "summary.json");
}

Campaign campaign(const fs::path& folder, const CampaignOptions& options, const std::string& text = kGrid) {
  return run_campaign(fake::catalogue(), text, "c.toml", folder, options);
}

TEST(CampaignOnRanks, SameTablesAndAllNewsToRankZero) {
  const fs::path folder = fake::test_folder();
  campaign(folder / "alone", {.threads = 1});
  fake::CountingListener counter;
  const auto work = [&](Ranks& ranks, const RunOptions&) {
    campaign(folder / "ranks",
             {.threads = 1 + ranks.rank(), .listener = ranks.rank() == 0 ? &counter : nullptr, .ranks = &ranks});
  };
  EXPECT_EQ(Ends(work).all(), "done");
  EXPECT_EQ(campaign_results(folder / "ranks"), campaign_results(folder / "alone"));
  EXPECT_EQ(counter.at_once, 6) << "threads of all ranks";
  EXPECT_EQ(counter.begun, 9);
  EXPECT_GE(counter.progressed, 1);
  EXPECT_EQ(counter.ended, 9);

  EXPECT_EQ(Ends(work).all(), "done") << "again, with nothing left to do";
  EXPECT_EQ(counter.begun, 9);
  EXPECT_EQ(campaign_results(folder / "ranks"), campaign_results(folder / "alone"));
}

TEST(CampaignOnRanks, FailedRunsAreRecorded) {
  const fs::path folder = fake::test_folder();
  const std::string text = kGrid + "[vary]\nbreaks = [false, true]\n[set]\nsearch.step = 3\n";
  EXPECT_GT(campaign(folder / "alone", {.threads = 1}, text).count(RunState::failed), 0);
  EXPECT_EQ(Ends([&](Ranks& ranks, const RunOptions&) {
              campaign(folder / "ranks", {.threads = 1, .ranks = &ranks}, text);
            }).all(),
            "done");
  EXPECT_EQ(campaign_results(folder / "ranks"), campaign_results(folder / "alone"));
}

TEST(CampaignOnRanks, ARankThatFailsEndsItOnTheFirstToo) {
  const fs::path folder = fake::test_folder() / "c";
  const Ends ends([&](Ranks& ranks, const RunOptions&) {
    const auto stop = [&] {
      if (ranks.rank() == 1) throw std::runtime_error("out of memory");
      return false;
    };
    campaign(folder, {.threads = 1, .stop = stop, .ranks = &ranks});
  });
  EXPECT_EQ(ends.all(), "done | out of memory | rank 1 failed: out of memory");
}

TEST(CampaignOnRanks, StoppedAndContinued) {
  const fs::path folder = fake::test_folder();
  campaign(folder / "alone", {.threads = 1});
  std::atomic<int> polls{0};
  const auto stop = [&] { return polls++ > 8; };
  std::atomic<Index> left{0};
  const Ends first([&](Ranks& ranks, const RunOptions&) {
    const Campaign part = campaign(folder / "ranks", {.threads = 1, .stop = stop, .ranks = &ranks});
    left += part.count(RunState::unfinished);
  });
  EXPECT_EQ(first.all(), "done");
  EXPECT_GT(left, 0);
  EXPECT_EQ(
      Ends([&](Ranks& ranks, const RunOptions&) { campaign(folder / "ranks", {.threads = 1, .ranks = &ranks}); }).all(),
      "done");
  EXPECT_EQ(campaign_results(folder / "ranks"), campaign_results(folder / "alone"));
}

TEST(CampaignOnRanks, WrongInputOnAll) {
  const fs::path folder = fake::test_folder();
  write_file(folder / "thesis.txt", "x");
  const Ends ends([&](Ranks& ranks, const RunOptions&) { campaign(folder, {.threads = 1, .ranks = &ranks}); });
  EXPECT_EQ(ends.all(), folder.string() + " already exists and is not the folder of a campaign; name another");
}

/// Throws at the start, or when a run ends.
class Thrower final : public CampaignListener {
 public:
  explicit Thrower(bool at_start) : at_start_(at_start) {}
  void started(const Campaign&, Index) override {
    if (at_start_) throw std::runtime_error("there is no terminal");
  }
  void run_ended(std::size_t, const RunOutcome&) override { throw std::runtime_error("the terminal is gone"); }

 private:
  bool at_start_;
};

TEST(CampaignOnRanks, AListenerThatThrowsAtTheStartEndsItOnAll) {
  const fs::path folder = fake::test_folder();
  Thrower thrower(true);
  const Ends ends([&](Ranks& ranks, const RunOptions&) {
    campaign(folder / "c", {.threads = 1, .listener = ranks.rank() == 0 ? &thrower : nullptr, .ranks = &ranks});
  });
  EXPECT_EQ(ends.all(), "there is no terminal");
}

TEST(CampaignOnRanks, AListenerThatThrowsEndsItOnAll) {
  const fs::path folder = fake::test_folder();
  Thrower thrower(false);
  const Ends ends([&](Ranks& ranks, const RunOptions&) {
    campaign(folder / "c", {.threads = 1, .listener = ranks.rank() == 0 ? &thrower : nullptr, .ranks = &ranks});
  });
  EXPECT_EQ(ends.all(), "done | the terminal is gone") << "only rank 0 knows, and nobody waits for ever";
}

TEST(Shares, TogetherAreTheCampaign) {
  const fs::path folder = fake::test_folder();
  campaign(folder / "alone", {.threads = 1});
  std::vector<std::thread> processes;
  for (Index number = 1; number <= 4; ++number)
    processes.emplace_back([&, number] {
      const Campaign share = campaign(folder / "shares", {.threads = 1, .share = {.number = number, .of = 4}});
      EXPECT_EQ(share.count(RunState::done), number == 1 ? 3 : 2);
    });
  for (std::thread& process : processes) process.join();
  EXPECT_FALSE(fs::exists(folder / "shares/campaign.csv"));
  fake::CountingListener counter;
  EXPECT_TRUE(campaign(folder / "shares", {.threads = 1, .listener = &counter}).complete());
  EXPECT_EQ(counter.begun, 0) << "no run is left";
  EXPECT_EQ(campaign_results(folder / "shares"), campaign_results(folder / "alone"));
}

TEST(Shares, AreNumberedFromOne) {
  const fs::path folder = fake::test_folder() / "shares";
  for (const Share share : {Share{0, 3}, Share{4, 3}, Share{0, 0}, Share{-1, -1}})
    EXPECT_THROW(campaign(folder, {.threads = 1, .share = share}), InvalidInput);
  EXPECT_FALSE(fs::exists(folder));
}

TEST(Shares, LeaveAloneWhatOthersAreMaking) {
  const fs::path folder = fake::test_folder() / "shares";
  const fs::path mine = folder / "runs/.line-echo-near-1.123", other = folder / "runs/.line-echo-near-2.123";
  campaign(folder, {.threads = 1, .share = {.number = 9, .of = 9}});
  fs::create_directories(mine);
  fs::create_directories(other);
  campaign(folder, {.threads = 1, .share = {.number = 1, .of = 9}});
  EXPECT_FALSE(fs::exists(mine));
  EXPECT_TRUE(fs::exists(other));
}

TEST(Shares, AndTheWholeExcludeEachOther) {
  const fs::path folder = fake::test_folder() / "shares";
  campaign(folder, {.threads = 1, .share = {.number = 1, .of = 9}});
  const CampaignOptions whole{.threads = 1}, share{.threads = 1, .share = {.number = 2, .of = 9}};
  const auto refusal = [&](const CampaignOptions& options) {
    return fake::message_of<InvalidInput>([&] { campaign(folder, options); });
  };
  {
    const FolderLock held(folder, FolderLock::Kind::shared);
    EXPECT_NE(refusal(whole).find("in use"), std::string::npos);
    EXPECT_EQ(refusal(share), "");
  }
  const FolderLock held(folder);
  EXPECT_NE(refusal(share).find("in use"), std::string::npos);
}

}  // namespace
}  // namespace rehearse::experiment
