// Campaigns on several ranks, which here are threads.
#include "rehearse/core/ranks.hpp"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "counting_listener.hpp"
#include "rank_ends.hpp"
#include "rehearse/campaign/campaign.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/test/fake.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::campaign {
namespace {

namespace fs = std::filesystem;

const std::string kNineRuns =
    "format = 1\nscenario = \"line\"\nlearners = [\"echo\", \"echo-alone\", \"pilco\"]\n"
    "priors = [\"near\", \"far\"]\nseeds = \"1-3\"\ntrials = 2\n";

std::string campaign_results(const fs::path& folder) {
  return files::read_file(folder / "campaign.csv") + files::read_file(folder / "summary.json");
}

Campaign campaign(const fs::path& folder, const CampaignOptions& options, const std::string& text = kNineRuns) {
  return run_campaign(experiment::fake::catalogue(), text, "c.toml", folder, options);
}

TEST(CampaignOnRanks, SameTablesAndAllNewsToRankZero) {
  const fs::path folder = experiment::fake::test_folder();
  campaign(folder / "alone", {.threads = 1});
  CountingListener counter;
  const auto work = [&](Ranks& ranks) {
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
  const fs::path folder = experiment::fake::test_folder();
  const std::string text = kNineRuns + "[vary]\nbreaks = [false, true]\n[set]\nsearch.step = 3\n";
  EXPECT_GT(campaign(folder / "alone", {.threads = 1}, text).count(RunState::failed), 0);
  EXPECT_EQ(Ends([&](Ranks& ranks) { campaign(folder / "ranks", {.threads = 1, .ranks = &ranks}, text); }).all(),
            "done");
  EXPECT_EQ(campaign_results(folder / "ranks"), campaign_results(folder / "alone"));
}

TEST(CampaignOnRanks, ARankThatFailsEndsItOnTheFirstToo) {
  const fs::path folder = experiment::fake::test_folder() / "c";
  const Ends ends([&](Ranks& ranks) {
    const auto stop = [&] {
      if (ranks.rank() == 1) throw std::runtime_error("out of memory");
      return false;
    };
    campaign(folder, {.threads = 1, .stop = stop, .ranks = &ranks});
  });
  EXPECT_EQ(ends.all(), "done | out of memory | rank 1 failed: out of memory");
}

TEST(CampaignOnRanks, StoppedAndContinued) {
  const fs::path folder = experiment::fake::test_folder();
  campaign(folder / "alone", {.threads = 1});
  std::atomic<int> polls{0};
  const auto stop = [&] { return polls++ > 8; };
  std::atomic<Index> left{0};
  const Ends first([&](Ranks& ranks) {
    const Campaign part = campaign(folder / "ranks", {.threads = 1, .stop = stop, .ranks = &ranks});
    left += part.count(RunState::unfinished);
  });
  EXPECT_EQ(first.all(), "done");
  EXPECT_GT(left, 0);
  EXPECT_EQ(Ends([&](Ranks& ranks) { campaign(folder / "ranks", {.threads = 1, .ranks = &ranks}); }).all(), "done");
  EXPECT_EQ(campaign_results(folder / "ranks"), campaign_results(folder / "alone"));
}

TEST(CampaignOnRanks, WrongInputOnAll) {
  const fs::path folder = experiment::fake::test_folder();
  files::write_file(folder / "thesis.txt", "x");
  const Ends ends([&](Ranks& ranks) { campaign(folder, {.threads = 1, .ranks = &ranks}); });
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
  const fs::path folder = experiment::fake::test_folder();
  Thrower thrower(true);
  const Ends ends([&](Ranks& ranks) {
    campaign(folder / "c", {.threads = 1, .listener = ranks.rank() == 0 ? &thrower : nullptr, .ranks = &ranks});
  });
  EXPECT_EQ(ends.all(), "there is no terminal");
}

TEST(CampaignOnRanks, AListenerThatThrowsEndsItOnAll) {
  const fs::path folder = experiment::fake::test_folder();
  Thrower thrower(false);
  const Ends ends([&](Ranks& ranks) {
    campaign(folder / "c", {.threads = 1, .listener = ranks.rank() == 0 ? &thrower : nullptr, .ranks = &ranks});
  });
  EXPECT_EQ(ends.all(), "done | the terminal is gone") << "only rank 0 knows, and nobody waits for ever";
}

TEST(Shares, TogetherAreTheCampaign) {
  const fs::path folder = experiment::fake::test_folder();
  campaign(folder / "alone", {.threads = 1});
  std::vector<std::thread> processes;
  for (Index number = 1; number <= 4; ++number)
    processes.emplace_back([&, number] {
      const Campaign share = campaign(folder / "shares", {.threads = 1, .share = {.number = number, .of = 4}});
      EXPECT_EQ(share.count(RunState::done), number == 1 ? 3 : 2);
    });
  for (std::thread& process : processes) process.join();
  EXPECT_FALSE(fs::exists(folder / "shares/campaign.csv"));
  CountingListener counter;
  EXPECT_TRUE(campaign(folder / "shares", {.threads = 1, .listener = &counter}).complete());
  EXPECT_EQ(counter.begun, 0) << "no run is left";
  EXPECT_EQ(campaign_results(folder / "shares"), campaign_results(folder / "alone"));
}

TEST(Shares, AreNumberedFromOne) {
  const fs::path folder = experiment::fake::test_folder() / "shares";
  for (const Share share : {Share{0, 3}, Share{4, 3}, Share{0, 0}, Share{-1, -1}})
    EXPECT_THROW(campaign(folder, {.threads = 1, .share = share}), InvalidInput);
  EXPECT_FALSE(fs::exists(folder));
}

TEST(Shares, LeaveAloneWhatOthersAreMaking) {
  const fs::path folder = experiment::fake::test_folder() / "shares";
  const fs::path mine = folder / "runs/.line-echo-near-1.123", other = folder / "runs/.line-echo-near-2.123";
  campaign(folder, {.threads = 1, .share = {.number = 9, .of = 9}});
  fs::create_directories(mine);
  fs::create_directories(other);
  campaign(folder, {.threads = 1, .share = {.number = 1, .of = 9}});
  EXPECT_FALSE(fs::exists(mine));
  EXPECT_TRUE(fs::exists(other));
}

TEST(Shares, AndTheWholeExcludeEachOther) {
  const fs::path folder = experiment::fake::test_folder() / "shares";
  campaign(folder, {.threads = 1, .share = {.number = 1, .of = 9}});
  const CampaignOptions whole{.threads = 1}, share{.threads = 1, .share = {.number = 2, .of = 9}};
  const auto refusal = [&](const CampaignOptions& options) {
    return experiment::fake::message_of<InvalidInput>([&] { campaign(folder, options); });
  };
  {
    const files::FolderLock held(folder, files::FolderLock::Kind::shared);
    EXPECT_NE(refusal(whole).find("in use"), std::string::npos);
    EXPECT_EQ(refusal(share), "");
  }
  const files::FolderLock held(folder);
  EXPECT_NE(refusal(share).find("in use"), std::string::npos);
}

}  // namespace
}  // namespace rehearse::campaign
