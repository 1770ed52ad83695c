#include "rehearse/campaign/ledger.hpp"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "counting_listener.hpp"
#include "line_campaign.hpp"

namespace rehearse::campaign {
namespace {

namespace fs = std::filesystem;

using line::kGrid, line::kThreeLearners, line::results_of, line::run, line::summary_of;

TEST(Ledger, GivesEachUnfinishedRunOnceInTheOrderOfThePlan) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  Campaign campaign = run(folder);
  for (const std::size_t i : {1u, 3u, 4u}) campaign.runs[i].state = RunState::unfinished;
  const CampaignOptions options{.threads = 1};
  const CampaignFolder joined = CampaignFolder::join(folder, kGrid);
  OwnLedger ledger(joined, campaign, options);
  EXPECT_EQ(ledger.next(), 1u);
  EXPECT_EQ(ledger.next(), 3u);
  ledger.stop();
  EXPECT_EQ(ledger.next(), std::nullopt);
}

TEST(Ledger, TablesGetWhatCameTooSoonAfterTheLastWrite) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  Campaign campaign = run(folder);
  const CampaignOptions options{.threads = 1};
  const CampaignFolder joined = CampaignFolder::join(folder, kGrid);
  OwnLedger ledger(joined, campaign, options);
  RunOutcome under_way = campaign.runs[0];
  under_way.state = RunState::unfinished;
  ledger.trial_done(0, under_way);
  ledger.trial_done(1, under_way);
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (summary_of(folder)["counts"]["unfinished"] != 2 && std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ledger.progress(1, 1, {});
  }
  EXPECT_EQ(summary_of(folder)["counts"]["unfinished"], 2);
}

TEST(Ledger, AFailureIsRecordedAndDoesNotStopTheOthers) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  const std::string text = kThreeLearners + "seeds = \"1-2\"\ntrials = 8\n[vary]\nbreaks = [false, true]\n";
  const Campaign campaign = run(folder, text, {.threads = 2});
  EXPECT_EQ(campaign.count(RunState::failed), 4);
  EXPECT_EQ(campaign.count(RunState::done), 4);
  const auto failed = summary_of(folder)["runs"][2];
  EXPECT_EQ(failed["state"], "failed");
  EXPECT_NE(failed["reason"].get<std::string>().find("the plant failed: the wheel came off"), std::string::npos);
  const std::string before = results_of(folder);
  run(folder, text);  // tries again, in vain
  EXPECT_EQ(results_of(folder), before);
}

TEST(Ledger, TellsItsListener) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  CountingListener first, second;
  run(folder, kGrid, {.threads = 2, .listener = &first});
  EXPECT_EQ(first.at_once, 2);
  EXPECT_EQ(first.begun, 6);
  EXPECT_EQ(first.progressed, 12);
  EXPECT_EQ(first.ended, 6);
  run(folder, kGrid, {.threads = 2, .listener = &second});
  EXPECT_EQ(second.at_once, 0);
  EXPECT_EQ(second.begun, 0);
}

}  // namespace
}  // namespace rehearse::campaign
