#include "rehearse/campaign/claim_plan.hpp"

#include <gtest/gtest.h>

#include "plans.hpp"

namespace rehearse::campaign {
namespace {

using plans::complaint, plans::kHead, plans::plan_of;

TEST(ClaimPlan, FindsWhatClaimsAreAbout) {
  const CampaignPlan plan = plan_of(R"(
    learners = ["echo", "echo-alone", "pilco"]
    priors = ["near", "far"]
    [vary]
    prior.drift = [0, 1]
    [[claim]]
    text = "each"
    learner = "echo"
    variants = ["prior.drift=1"]
    solved_by = 2
    at_least_runs = 1
    [[claim]]
    text = "pooled"
    learner = "echo"
    priors = ["far"]
    pooled = true
    better_than = { learner = "echo-alone" }
    metric = "best_return"
    [[claim]]
    text = "by prior"
    learner = "echo"
    priors = ["far"]
    not_worse_than = { prior = "near" }
    metric = "first_success"
    trial = 2
    [[claim]]
    text = "missing"
    learner = "echo-alone"
    better_than = { learner = "pilco" }
    metric = "return"
  )");
  ASSERT_EQ(plan.claims.size(), 4u);
  const PlannedClaim &each = plan.claims[0], &pooled = plan.claims[1], &by_prior = plan.claims[2];
  ASSERT_EQ(each.parts.size(), 2u);
  EXPECT_EQ(each.parts[1].groups, (std::vector<std::size_t>{3}));
  ASSERT_EQ(pooled.parts.size(), 1u);
  EXPECT_EQ(pooled.parts[0].groups, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(pooled.parts[0].against, (std::vector<std::size_t>{4, 4}));
  ASSERT_EQ(by_prior.parts.size(), 2u);
  EXPECT_EQ(by_prior.parts[1].against, (std::vector<std::size_t>{1}));
  EXPECT_EQ(by_prior.claim.comparison->measure.trial, 2);
  EXPECT_EQ(pooled.claim.comparison->measure.trial, 3);
  EXPECT_EQ(plan.claims[3].missing, "learner 'pilco' is not built: not written yet");
}

TEST(ClaimPlan, ComparesRunsOfTheSameVariant) {
  const CampaignPlan plan = plan_of(R"(
    learners = ["echo", "echo-alone"]
    [[variant]]
    name = "default"
    [[variant]]
    name = "noisy"
    set.noise = 1
    [[variant]]
    name = "bold"
    set.prior.gain = 1.5
    [[claim]]
    text = "each"
    learner = "echo"
    better_than = { learner = "echo-alone" }
    metric = "return"
  )");
  ASSERT_EQ(plan.groups.size(), 5u);  // echo-alone has no prior to be bold about: its defaults stand for that
  std::vector<std::size_t> against;
  for (const ClaimPart& part : plan.claims[0].parts)
    against.insert(against.end(), part.against.begin(), part.against.end());
  EXPECT_EQ(against, (std::vector<std::size_t>{3, 4, 3}));
}

TEST(ClaimPlan, AClaimIsAboutSomeRuns) {
  const std::string file =
      kHead +
      "learners = [\"echo\"]\npriors = [\"near\", \"far\"]\n[vary]\nprior.near.drift = [0, 1]\n[[claim]]\ntext = "
      "\"x\"\n"
      "learner = \"echo\"\npriors = [\"far\"]\nvariants = [\"prior.near.drift=1\"]\nsolved_by = 2\nat_least_runs = 1\n";
  EXPECT_NE(complaint(file).find("no runs have both one of these priors and one of these variants"), std::string::npos)
      << complaint(file);
}

TEST(ClaimPlan, SaysWhatIsWrongWithClaims) {
  const auto about = [](const std::string& claim) {
    return complaint(kHead + "learners = [\"echo\"]\n[[claim]]\ntext = \"x\"\n" + claim);
  };
  const std::string success = "learner = \"echo\"\nsolved_by = 2\n";
  EXPECT_EQ(about(success), "c.toml: line 6: how many? at_least_runs, at_most_runs, at_least_rate or at_most_rate");
  EXPECT_EQ(about(success + "at_least_runs = 3\n"), "c.toml: line 6: at_least_runs = 3, but the claim is about 2 runs");
  EXPECT_EQ(about("learner = \"echo\"\nreached_by = 2\nat_most_runs = 2\n"),
            "c.toml: line 6: reached_by needs return_at_least");
  EXPECT_EQ(about(success + "at_least_runs = 2\nat_most_runs = 1\n"),
            "c.toml: line 6: at_most_runs = 1, must be ≥ at_least_runs = 2");
  EXPECT_EQ(about(success + "at_least_rate = 0.9\nat_most_rate = 0.1\n"),
            "c.toml: line 6: at_most_rate = 0.1, must be ≥ at_least_rate = 0.9");
  EXPECT_EQ(about("learner = \"echo\"\nmetric = \"return\"\nmedian_at_least = 5\nmedian_at_most = 1\n"),
            "c.toml: line 6: median_at_most = 1, must be ≥ median_at_least = 5");
  EXPECT_EQ(about(success + "at_least_rate = 95\n"), "c.toml: line 10: at_least_rate = 95, must be between 0 and 1");
  EXPECT_EQ(about("learner = \"echo\"\nsolved_by = 4\nat_least_runs = 1\n"),
            "c.toml: line 9: solved_by = 4, must be between 1 and 3");
  EXPECT_EQ(about("learner = \"eco\"\nsolved_by = 1\nat_least_runs = 1\n"),
            "c.toml: line 6: the claim's learner 'eco' is none of the learners (echo)");
  EXPECT_EQ(about(success + "at_least_runs = 1\npriors = [\"far\"]\n"),
            "c.toml: line 6: learner echo has no prior 'far'");
  EXPECT_EQ(about("learner = \"echo\"\nbetter_than = { learner = \"echo\" }\nmetric = \"return\"\n"),
            "c.toml: line 6: the claim compares runs with themselves");
  EXPECT_EQ(about("learner = \"echo\"\nbetter_than = { prior = \"far\" }\nmetric = \"return\"\n"),
            "c.toml: line 6: there is nothing to compare with: no runs of learner echo, prior 'far', variant ''");
  EXPECT_EQ(about("learner = \"echo\"\nmedian_at_least = 1\n"),
            "c.toml: line 6: metric is missing: \"return\", \"best_return\" or \"first_success\"");
  EXPECT_EQ(
      about("learner = \"echo\"\n"),
      "c.toml: line 6: a claim has one of solved_by, reached_by, better_than, not_worse_than, and median_at_least or "
      "median_at_most");
}

}  // namespace
}  // namespace rehearse::campaign
