#include "rehearse/campaign/summary.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "line_campaign.hpp"
#include "rehearse/campaign/planner.hpp"
#include "rehearse/files/table.hpp"

namespace rehearse::campaign {
namespace {

namespace fs = std::filesystem;

using line::kClaim, line::kGrid, line::kThreeLearners, line::run, line::summary_of;

TEST(Summary, CsvHasARowForEveryTrialInTheOrderOfTheFile) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  EXPECT_TRUE(run(folder).complete());
  const files::Table table = files::read_csv(files::read_file(folder / "campaign.csv"));
  EXPECT_EQ(table.header,
            (std::vector<std::string>{"run", "scenario", "learner", "prior", "variant", "seed", "trial",
                                      "interaction_s", "return", "solved", "predicted_return", "rollouts",
                                      "failed_rollouts", "log_evidence", "phi.gain", "phi.gain.low", "phi.gain.high"}));
  ASSERT_EQ(table.rows.size(), 12u);
  EXPECT_EQ(table.rows[3][0], "line-echo-near-2");
  EXPECT_EQ(table.rows[3][6], "2");
  EXPECT_EQ(table.rows[11][0], "line-echo-alone-none-2");
  EXPECT_EQ(table.rows[11][3], "");

  const files::Table one = files::read_csv(files::read_file(folder / "runs/line-echo-near-2/trials.csv"));
  EXPECT_EQ(std::vector<std::string>(table.rows[3].begin() + 6, table.rows[3].end()), one.rows[1]);
  EXPECT_EQ(files::read_file(folder / "campaign.toml"), kGrid);
}

TEST(Summary, HoldsRunsGroupsAndClaims) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  const Campaign campaign = run(folder, kGrid + kClaim);
  const auto summary = summary_of(folder);
  EXPECT_EQ(summary["format"], 1);
  EXPECT_EQ(summary["complete"], true);
  EXPECT_EQ(summary["counts"], (nlohmann::json{{"runs", 6}, {"done", 6}, {"failed", 0}, {"unfinished", 0}}));
  EXPECT_EQ(summary["missing"][0]["learner"], "pilco");
  EXPECT_EQ(summary["priors"], (nlohmann::json{"near", "far", ""}));
  ASSERT_EQ(summary["runs"].size(), 6u);
  EXPECT_EQ(summary["runs"][5]["folder"], "runs/line-echo-alone-none-2");
  EXPECT_EQ(summary["runs"][5]["state"], "done");
  ASSERT_EQ(summary["groups"].size(), 3u);
  const auto& trial = summary["groups"][1]["trials"][1];
  EXPECT_EQ(trial["runs"], 2);
  EXPECT_EQ(trial["interaction_s"], 2.4);
  EXPECT_EQ(trial["solved_by"]["runs"], 2);
  std::vector<double> returns;
  for (std::size_t seed = 0; seed < 2; ++seed) returns.push_back(campaign.outcome(1, seed).returns[1]);
  EXPECT_EQ(trial["return"]["median"], statistics::median(returns));
  EXPECT_EQ(summary["claims"][0]["text"], "it works");
  EXPECT_EQ(summary["claims"][0]["kind"], "success");
  EXPECT_EQ(summary["claims"][0]["parts"].size(), 2u);
  EXPECT_EQ(summary["claims"][0]["parts"][1]["priors"], nlohmann::json{"far"});
}

TEST(Summary, FailedRunsCountAsNotSolvedAndKeepTheirRows) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  const Campaign campaign =
      run(folder, kThreeLearners + "seeds = \"1-2\"\ntrials = 8\n[vary]\nbreaks = [false, true]\n");
  const RunOutcome& failed = campaign.outcome(1, 0);
  ASSERT_LT(failed.done(), 8);
  const auto rows = files::read_csv(files::read_file(folder / "campaign.csv"));
  Index kept = 0;
  for (const auto& row : rows.rows) kept += row[0] == campaign.plan.run(1, 0).name;
  EXPECT_EQ(kept, failed.done());
  const std::vector<TrialStatistics> trials = trial_statistics(campaign, 1);
  ASSERT_FALSE(trials.empty());
  EXPECT_EQ(trials.back().solved_by->of, 2);
}

/// A group of three runs: solved at trial 1, solved at trial 2, and under way after one trial.
Campaign two_solved_and_one_under_way(bool until_solved) {
  const std::string text = kThreeLearners + "priors = [\"near\"]\nseeds = \"1-3\"\ntrials = 4\nuntil_solved = " +
                           (until_solved ? "true\n" : "false\n");
  Campaign campaign{.plan = plan_campaign(experiment::fake::catalogue(), text, "c.toml")};
  campaign.runs.resize(campaign.plan.runs.size());
  campaign.runs[0] = {.state = RunState::done, .interaction_s = {1}, .returns = {20}, .solved = {true}};
  campaign.runs[1] = {.state = RunState::done, .interaction_s = {1, 2}, .returns = {4, 21}, .solved = {false, true}};
  campaign.runs[2] = {.interaction_s = {1}, .returns = {3}, .solved = {false}};
  return campaign;
}

TEST(Summary, AGroupWhoseRunsAllFailedHasSolvedNone) {
  Campaign campaign = two_solved_and_one_under_way(true);
  for (std::size_t seed = 0; seed < 3; ++seed) campaign.runs[seed] = {.state = RunState::failed};
  const std::vector<TrialStatistics> trials = trial_statistics(campaign, 0);
  ASSERT_EQ(trials.size(), 4u);
  EXPECT_EQ(trials[3].runs, 0);
  EXPECT_TRUE(std::isnan(trials[3].total_reward.median));
  EXPECT_EQ(trials[3].solved_by->count, 0);
  EXPECT_EQ(trials[3].solved_by->of, 3);
}

TEST(Summary, RunsUnderWayCountWhereOthersEndEarly) {
  const Campaign campaign = two_solved_and_one_under_way(true);
  EXPECT_EQ(campaign.count(RunState::done, 0), 2);
  EXPECT_EQ(campaign.count(RunState::done, 1), 0);
  const std::vector<TrialStatistics> trials = trial_statistics(campaign, 0);
  ASSERT_EQ(trials.size(), 4u);
  EXPECT_EQ(trials[3].runs, 3);
  EXPECT_EQ(trials[3].solved_by->count, 2);
  EXPECT_EQ(trials[3].solved_by->of, 3);
  EXPECT_EQ(trials[3].best_return.min, 3);
  EXPECT_EQ(trial_statistics(two_solved_and_one_under_way(false), 0)[3].runs, 2);
}

TEST(Summary, TimesAreOfTheRunsThatDidTheTrial) {
  const std::vector<TrialStatistics> trials = trial_statistics(two_solved_and_one_under_way(true), 0);
  EXPECT_EQ(trials[0].interaction_s, 1);
  EXPECT_EQ(trials[1].interaction_s, 2);
  EXPECT_TRUE(std::isnan(trials[2].interaction_s));
}

}  // namespace
}  // namespace rehearse::campaign
