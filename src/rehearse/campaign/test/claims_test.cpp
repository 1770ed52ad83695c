#include "rehearse/campaign/claims.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/campaign/planner.hpp"
#include "rehearse/experiment/test/fake.hpp"
#include "rehearse/statistics/intervals.hpp"

namespace rehearse::campaign {
namespace {

constexpr double kSolvedFrom = 20;  // a return that counts as solved, in these tests

/// A campaign of learners echo (priors near and far) and echo-alone, 8 seeds and 2 trials, with one claim and no run.
Campaign campaign_with(const std::string& claim) {
  const std::string head =
      "format = 1\nscenario = \"line\"\nlearners = [\"echo\", \"echo-alone\", \"pilco\"]\npriors = [\"near\", "
      "\"far\"]\n"
      "seeds = \"1-8\"\ntrials = 2\n[[claim]]\ntext = \"x\"\n";
  Campaign campaign{.plan = plan_campaign(experiment::fake::catalogue(), head + claim, "c.toml")};
  campaign.runs.resize(campaign.plan.runs.size());
  return campaign;
}

RunOutcome run_of(const std::vector<double>& returns) {
  RunOutcome run{.state = returns.size() == 2 ? RunState::done : RunState::unfinished, .returns = returns};
  for (double value : returns) run.solved.push_back(value >= kSolvedFrom);
  return run;
}

/// The returns of both trials of a group, by seed.
void set_group(Campaign& campaign, std::size_t group, const std::vector<double>& first,
               const std::vector<double>& second) {
  for (std::size_t seed = 0; seed < second.size(); ++seed)
    campaign.runs[group * 8 + seed] = run_of({first[seed], second[seed]});
}

const std::vector<double> kLow = {1, 2, 3, 4, 5, 6, 7, 8}, kHigh = {21, 22, 23, 24, 25, 26, 27, 28};
const std::vector<double> kSixSolved = {21, 22, 23, 24, 25, 26, 7, 8};

TEST(Claims, SuccessByCount) {
  Campaign campaign = campaign_with("learner = \"echo\"\npriors = [\"near\"]\nsolved_by = 2\nat_least_runs = 6\n");
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::undecided);
  EXPECT_EQ(judge(campaign)[0].parts[0].reason, "0 of 8 runs are done");
  set_group(campaign, 0, kLow, kSixSolved);
  const ClaimResult result = judge(campaign)[0];
  EXPECT_EQ(result.verdict, Verdict::pass);
  ASSERT_EQ(result.parts.size(), 1u);
  EXPECT_EQ(result.parts[0].count, 6);
  EXPECT_EQ(result.parts[0].runs, 8);
  EXPECT_EQ(result.parts[0].estimate, 0.75);
  EXPECT_EQ(result.parts[0].interval.low, statistics::rate_interval(6, 8).low);
  EXPECT_EQ(result.parts[0].measure, "solved by trial 2");
  EXPECT_EQ(result.parts[0].required, "count ≥ 6");
}

TEST(Claims, SuccessInAnEarlierTrialCounts) {
  Campaign campaign = campaign_with("learner = \"echo\"\npriors = [\"near\"]\nsolved_by = 2\nat_least_runs = 8\n");
  set_group(campaign, 0, kHigh, kLow);
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::pass);
}

TEST(Claims, CountIsDecidedOnceTheRestCannotChangeIt) {
  Campaign campaign = campaign_with("learner = \"echo\"\npriors = [\"near\"]\nsolved_by = 2\nat_least_runs = 7\n");
  campaign.runs[0] = run_of({1, 1});
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::undecided);
  campaign.runs[1].state = RunState::failed;  // never solved
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::fail);
  for (std::size_t seed = 0; seed < 7; ++seed) campaign.runs[seed] = run_of({30, 30});
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::pass);
}

TEST(Claims, AnEarlySuccessCountsOnceItsRunHasComeThatFar) {
  Campaign campaign = campaign_with("learner = \"echo\"\npriors = [\"near\"]\nsolved_by = 2\nat_least_runs = 1\n");
  campaign.runs[0] = run_of({30});
  EXPECT_EQ(judge(campaign)[0].parts[0].runs, 0);
  campaign.runs[0] = run_of({30, 1});
  EXPECT_EQ(judge(campaign)[0].parts[0].runs, 1);
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::pass);
}

TEST(Claims, RateIsDecidedByItsInterval) {
  const auto verdict = [](const std::string& more) {
    Campaign campaign = campaign_with("learner = \"echo\"\npriors = [\"near\"]\nsolved_by = 2\n" + more);
    set_group(campaign, 0, kLow, kSixSolved);  // 0.75, between 0.35 and 0.97
    return judge(campaign)[0].verdict;
  };
  EXPECT_EQ(verdict("at_least_rate = 0.34\n"), Verdict::pass);
  EXPECT_EQ(verdict("at_least_rate = 0.36\n"), Verdict::undecided);
  EXPECT_EQ(verdict("at_least_rate = 0.96\n"), Verdict::undecided);
  EXPECT_EQ(verdict("at_least_rate = 0.97\n"), Verdict::fail);
  EXPECT_EQ(verdict("at_least_rate = 0.7\nobserved = true\n"), Verdict::pass);
  EXPECT_EQ(verdict("at_least_rate = 0.8\nobserved = true\n"), Verdict::fail);
  EXPECT_EQ(verdict("at_least_rate = 0.36\nat_least_runs = 7\n"), Verdict::fail);
  EXPECT_EQ(verdict("at_least_rate = 0.36\nat_least_runs = 6\n"), Verdict::undecided);
}

TEST(Claims, SuccessCanBeBoundedFromAbove) {
  const auto verdict = [](const std::string& more, Index done) {
    Campaign campaign = campaign_with("learner = \"echo\"\npriors = [\"near\"]\nsolved_by = 2\n" + more);
    set_group(campaign, 0, kLow, kSixSolved);
    for (std::size_t seed = static_cast<std::size_t>(done); seed < 8; ++seed) campaign.runs[seed] = {};
    return judge(campaign)[0].verdict;
  };
  EXPECT_EQ(verdict("at_most_runs = 6\n", 8), Verdict::pass);
  EXPECT_EQ(verdict("at_most_runs = 6\n", 7), Verdict::undecided);
  EXPECT_EQ(verdict("at_most_runs = 5\n", 6), Verdict::fail);
  EXPECT_EQ(verdict("at_most_rate = 0.97\n", 8), Verdict::pass);
  EXPECT_EQ(verdict("at_most_rate = 0.5\n", 8), Verdict::undecided);
  EXPECT_EQ(verdict("at_most_rate = 0.34\n", 8), Verdict::fail);
  EXPECT_EQ(verdict("at_most_rate = 0.34\n", 7), Verdict::undecided);
}

TEST(Claims, SuccessCanBeAReturn) {
  Campaign campaign = campaign_with(
      "learner = \"echo\"\npriors = [\"near\"]\nreached_by = 1\nreturn_at_least = 4\nat_least_runs = 5\n");
  set_group(campaign, 0, kLow, kHigh);
  for (RunOutcome& run : campaign.runs) run.solved.assign(run.solved.size(), std::nullopt);  // needs none
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::pass);
  EXPECT_EQ(judge(campaign)[0].parts[0].count, 5);
  EXPECT_EQ(judge(campaign)[0].parts[0].measure, "return of 4 reached by trial 1");
}

TEST(Claims, EachPriorMustPassUnlessTheyArePooled) {
  for (const bool pooled : {false, true}) {
    Campaign campaign = campaign_with(std::string("learner = \"echo\"\nsolved_by = 1\nat_least_runs = 8\npooled = ") +
                                      (pooled ? "true\n" : "false\n"));
    set_group(campaign, 0, kHigh, kHigh);
    EXPECT_EQ(judge(campaign)[0].verdict, pooled ? Verdict::pass : Verdict::undecided);
    set_group(campaign, 1, kLow, kHigh);
    EXPECT_EQ(judge(campaign)[0].verdict, pooled ? Verdict::pass : Verdict::fail);
    EXPECT_EQ(judge(campaign)[0].parts.size(), pooled ? 1u : 2u);
    EXPECT_EQ(judge(campaign)[0].parts[0].of, pooled ? 16 : 8);
  }
}

Campaign comparison(const std::string& more) {
  return campaign_with("learner = \"echo\"\npriors = [\"near\"]\n" + more);
}

TEST(Claims, ComparisonIsPairedBySeed) {
  Campaign campaign = comparison("better_than = { learner = \"echo-alone\" }\nmetric = \"return\"\n");
  set_group(campaign, 0, kLow, {2, 3, 4, 5, 6, 7, 8, 9});
  set_group(campaign, 2, kHigh, kLow);  // worse by 1 each, though they overlap
  const PartResult part = judge(campaign)[0].parts[0];
  EXPECT_EQ(part.verdict, Verdict::pass);
  EXPECT_EQ(part.estimate, 1);
  EXPECT_EQ(part.interval.low, 1);
  EXPECT_EQ(part.measure, "return of trial 2");
  EXPECT_EQ(part.required, "difference > 0");
  campaign.runs[2 * 8 + 3] = run_of({4});
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::undecided);
  EXPECT_EQ(judge(campaign)[0].parts[0].reason, "7 of 8 pairs are done");
  campaign.runs[2 * 8 + 3].state = RunState::failed;
  EXPECT_EQ(judge(campaign)[0].parts[0].reason, "1 of 8 pairs without such a value, since runs failed");
}

TEST(Claims, ComparisonFailsWhenItIsTheOtherWayRoundOrEqual) {
  Campaign campaign = comparison("better_than = { learner = \"echo-alone\" }\nmetric = \"return\"\ntrial = 1\n");
  set_group(campaign, 0, kLow, kLow);
  set_group(campaign, 2, kHigh, kLow);
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::fail);
  EXPECT_EQ(judge(campaign)[0].parts[0].estimate, -20);
  set_group(campaign, 2, kLow, kLow);
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::fail);
  set_group(campaign, 2, {8, 7, 6, 5, 4, 3, 2, 1}, kLow);
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::undecided);
  EXPECT_EQ(judge(campaign)[0].parts[0].reason, "the interval does not decide");
}

TEST(Claims, NotWorseAllowsTheMargin) {
  const auto verdict = [](const std::string& margin) {
    Campaign campaign = comparison("not_worse_than = { prior = \"far\" }\nmetric = \"best_return\"\n" + margin);
    set_group(campaign, 0, kLow, {0, 0, 0, 0, 0, 0, 0, 0});  // best: that of trial 1
    set_group(campaign, 1, {2, 3, 4, 5, 6, 7, 8, 9}, kLow);  // better by 1
    return judge(campaign)[0].verdict;
  };
  EXPECT_EQ(verdict(""), Verdict::fail);
  EXPECT_EQ(verdict("margin = 0.5\n"), Verdict::fail);
  EXPECT_EQ(verdict("margin = 1\n"), Verdict::pass);
}

TEST(Claims, FirstSuccessIsBetterWhenItIsEarlier) {
  Campaign campaign = comparison("better_than = { learner = \"echo-alone\" }\nmetric = \"first_success\"\n");
  set_group(campaign, 0, kHigh, kLow);
  set_group(campaign, 2, kLow, kLow);  // never: counts as trial 3
  const PartResult part = judge(campaign)[0].parts[0];
  EXPECT_EQ(part.verdict, Verdict::pass);
  EXPECT_EQ(part.estimate, 2);
  EXPECT_EQ(part.measure, "trial of first success");
}

TEST(Claims, PooledComparisonAveragesTheGroupsOfASeed) {
  Campaign campaign = campaign_with(
      "learner = \"echo\"\npooled = true\nbetter_than = { learner = \"echo-alone\" }\nmetric = \"return\"\n");
  set_group(campaign, 0, kLow, kHigh);
  set_group(campaign, 1, kLow, kLow);
  set_group(campaign, 2, kLow, kLow);
  const PartResult part = judge(campaign)[0].parts[0];
  EXPECT_EQ(part.of, 8);
  EXPECT_EQ(part.runs, 8);
  EXPECT_EQ(part.estimate, 10);
}

TEST(Claims, Median) {
  const auto verdict = [](const std::string& more) {
    Campaign campaign = campaign_with("learner = \"echo-alone\"\nmetric = \"return\"\n" + more);
    set_group(campaign, 2, kHigh, kLow);  // 4.5, between 1 and 8 by the sign test
    return judge(campaign)[0].verdict;
  };
  EXPECT_EQ(verdict("median_at_least = 1\n"), Verdict::pass);
  EXPECT_EQ(verdict("median_at_least = 4\n"), Verdict::undecided);
  EXPECT_EQ(verdict("median_at_least = 4\nobserved = true\n"), Verdict::pass);
  EXPECT_EQ(verdict("median_at_least = 9\n"), Verdict::fail);
  EXPECT_EQ(verdict("median_at_most = 8\n"), Verdict::pass);
  EXPECT_EQ(verdict("median_at_most = 7\n"), Verdict::undecided);
  EXPECT_EQ(verdict("median_at_most = 0\n"), Verdict::fail);
  EXPECT_EQ(verdict("median_at_least = 1\nmedian_at_most = 7\n"), Verdict::undecided);
}

TEST(Claims, AboutAMissingLearnerAreUndecided) {
  const Campaign campaign = campaign_with("learner = \"pilco\"\nsolved_by = 1\nat_least_runs = 1\n");
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::undecided);
  EXPECT_EQ(judge(campaign)[0].parts[0].reason, "learner 'pilco' is not built: not written yet");
}

TEST(Claims, AScenarioThatCannotSaySolvedDecidesNothing) {
  Campaign campaign = campaign_with("learner = \"echo-alone\"\nsolved_by = 1\nat_least_runs = 8\n");
  set_group(campaign, 2, kHigh, kHigh);
  for (RunOutcome& run : campaign.runs) run.solved.assign(run.solved.size(), std::nullopt);
  EXPECT_EQ(judge(campaign)[0].verdict, Verdict::undecided);
  EXPECT_EQ(judge(campaign)[0].parts[0].reason, "the scenario cannot say what is solved");
}

TEST(Claims, FewRunsProveNothingByAnInterval) {
  Campaign campaign = campaign_with("learner = \"echo-alone\"\nmetric = \"return\"\nmedian_at_least = 0\n");
  campaign.plan.seeds.resize(3);
  campaign.runs.assign(9, run_of({5, 5}));
  EXPECT_EQ(judge(campaign)[0].parts[0].reason, "an interval needs 6 runs");
}

}  // namespace
}  // namespace rehearse::campaign
