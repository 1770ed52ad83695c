#include "rehearse/campaign/results.hpp"

#include <gtest/gtest.h>

#include "line_campaign.hpp"

namespace rehearse::campaign {
namespace {

namespace fs = std::filesystem;

using line::kClaim, line::kThreeLearners, line::results_of, line::run, line::summary_of;

files::Table three_trials() {
  return {.header = {"interaction_s", "return", "solved"},
          .rows = {{"1.2", "3", "0"}, {"2.4", "", ""}, {"3.6", "2", "1"}}};
}

TEST(RunOutcome, IsReadFromATableUpToThePlannedTrials) {
  const RunOutcome all = outcome_of(three_trials(), 5), two = outcome_of(three_trials(), 2);
  EXPECT_EQ(all.state, RunState::unfinished);
  EXPECT_EQ(all.done(), 3);
  EXPECT_EQ(all.interaction_s, (std::vector<double>{1.2, 2.4, 3.6}));
  EXPECT_EQ(all.returns[1], -kInf) << "there is none";
  EXPECT_EQ(all.solved, (std::vector<std::optional<bool>>{false, std::nullopt, true}));
  EXPECT_EQ(all.first_success(3), 3);
  EXPECT_EQ(all.first_success(2), std::nullopt);
  EXPECT_EQ(all.best_return(3), 3);
  EXPECT_EQ(two.done(), 2);
  EXPECT_EQ(two.trials.rows.size(), 2u);
}

TEST(Campaign, RemarksSayWhatIsNotRun) {
  Campaign campaign;
  campaign.plan.missing.push_back({"ite", "learner 'ite' is not built"});
  campaign.plan.runs.resize(2);
  campaign.plan.runs[1].name = "line-echo-2";
  campaign.skipped.push_back({"runs/other", "it is no run of this campaign"});
  campaign.runs.resize(2);
  campaign.runs[1].fail("the plant failed");
  EXPECT_EQ(campaign.remarks().size(), 2u) << "it is tried again";
  campaign.runs[1].unusable = true;
  EXPECT_EQ(campaign.remarks(), (std::vector<std::string>{"missing: learner 'ite' is not built",
                                                          "skipped: runs/other: it is no run of this campaign",
                                                          "cannot be used: line-echo-2: the plant failed"}));
}

TEST(RunOutcome, ALastTrialStandsForLaterOnesOnceTheRunIsDone) {
  RunOutcome outcome = outcome_of(three_trials(), 3);
  EXPECT_EQ(outcome.row_of(3), 2u);
  EXPECT_EQ(outcome.row_of(4), std::nullopt);
  EXPECT_FALSE(outcome.decided(4));
  outcome.state = RunState::done;
  EXPECT_EQ(outcome.row_of(9), 2u);
  outcome.fail("the wheel\ncame off");
  EXPECT_EQ(outcome.reason, "the wheel; came off");
  EXPECT_EQ(outcome.row_of(9), std::nullopt);
  EXPECT_TRUE(outcome.decided(9)) << "it never will be reached";
}

TEST(RunOutcome, RunsThatEndOnceSolvedCountAsTheyEnded) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  const std::string grid = kThreeLearners + "priors = [\"near\"]\nseeds = \"1-3\"\ntrials = 8\n" + kClaim;
  const Campaign ended = run(folder, "until_solved = true\n" + grid);
  EXPECT_TRUE(ended.complete());
  const auto counts = [&](const char* trial_measure) {
    std::vector<Index> all;
    const auto summary = summary_of(folder);
    for (const auto& group : summary["groups"])
      for (const auto& trial : group["trials"]) all.push_back(trial[trial_measure]["count"]);
    return all;
  };
  const std::vector<Index> solved_by = counts("solved_by");
  EXPECT_EQ(solved_by.size(), 16u);
  EXPECT_EQ(counts("solved"), solved_by);
  Index ended_early = 0;
  for (const RunOutcome& outcome : ended.runs) {
    ended_early += outcome.done() < 8;
    for (Index trial = 1; trial < outcome.done(); ++trial) EXPECT_FALSE(*outcome.solved[trial - 1]);
    EXPECT_EQ(outcome.row_of(8), outcome.done() - 1);
  }
  EXPECT_GT(ended_early, 0);
  const auto parts = summary_of(folder)["claims"][0]["parts"];
  EXPECT_TRUE(run(folder, grid).complete());  // goes on
  EXPECT_EQ(counts("solved_by"), solved_by);
  EXPECT_EQ(summary_of(folder)["claims"][0]["parts"], parts);
  run(folder.string() + "-whole", grid);
  EXPECT_EQ(results_of(folder), results_of(folder.string() + "-whole"));
}

}  // namespace
}  // namespace rehearse::campaign
