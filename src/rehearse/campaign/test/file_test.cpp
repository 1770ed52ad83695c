#include "rehearse/campaign/file.hpp"

#include <gtest/gtest.h>

#include "plans.hpp"
#include "rehearse/files/toml_reader.hpp"

namespace rehearse::campaign {
namespace {

using plans::complaint, plans::kHead;

/// Reads a file in which nothing is wrong.
CampaignFile read(const std::string& text) {
  files::FileViolations violations("c.toml");
  CampaignFile file = read_campaign_file(text, "c.toml", violations);
  violations.throw_if_any();
  return file;
}

TEST(CampaignFile, IsReadAsItIsWritten) {
  const CampaignFile file = read(R"(format = 1
title = "the line"
scenario = "line"
learners = ["echo", "other"]
seeds = "5-7"
until_solved = true
[set]
noise = 0.5
[learner.other]
step = 2
[vary]
gain = [1, 2.5]
[draw]
drift = [-1, 1]
)");
  EXPECT_EQ(file.title, "the line");
  EXPECT_EQ(file.learners, (std::vector<std::string>{"echo", "other"}));
  EXPECT_EQ(file.seeds, (std::vector<Index>{5, 6, 7}));
  EXPECT_EQ(file.trials, 10);
  EXPECT_TRUE(file.until_solved);
  ASSERT_EQ(file.options.size(), 1u);
  EXPECT_EQ(file.options[0].key + " = " + file.options[0].text, "noise = 0.5");
  EXPECT_EQ(file.options[0].line, 8);
  EXPECT_EQ(file.learner_options.at("other").at(0).line, 10);
  EXPECT_EQ(file.lines.at("learner.other"), 9);
  ASSERT_EQ(file.axes.size(), 1u);
  EXPECT_EQ(file.axes[0].texts, (std::vector<std::string>{"1", "2.5"}));
  ASSERT_EQ(file.draws.size(), 1u);
  EXPECT_EQ(file.draws[0].low, -1);
  EXPECT_EQ(file.draws[0].line, 14);
}

TEST(CampaignFile, ClaimsHaveOneMeasureEach) {
  const CampaignFile file = read(kHead + R"(learners = ["echo"]
[[claim]]
text = "mostly"
learner = "echo"
reached_by = 2
return_at_least = 7.5
at_least_rate = 0.9
[[claim]]
text = "not worse"
learner = "echo"
not_worse_than = { prior = "far" }
metric = "best_return"
[[claim]]
text = "high"
learner = "echo"
median_at_least = 3
metric = "return"
)");
  ASSERT_EQ(file.claims.size(), 3u);
  const Claim &success = file.claims[0], &comparison = file.claims[1], &median = file.claims[2];
  ASSERT_TRUE(success.success && comparison.comparison && median.median);
  EXPECT_FALSE(success.comparison || success.median || comparison.success || median.success);
  EXPECT_EQ(success.success->measure.trial, 2);
  EXPECT_EQ(success.success->measure.success_return, 7.5);
  EXPECT_EQ(success.success->at_least_rate, 0.9);
  EXPECT_EQ(comparison.comparison->prior, "far");
  EXPECT_TRUE(comparison.comparison->not_worse_by);
  EXPECT_EQ(comparison.comparison->measure.metric, Metric::best_return);
  EXPECT_EQ(median.median->at_least, 3);
  EXPECT_EQ(median.line, 17);
}

TEST(CampaignFile, SaysAllThatIsWrongWithItsLine) {
  EXPECT_EQ(complaint("format = 2\n"),
            "c.toml: learners is missing\nc.toml: scenario is missing\n"
            "c.toml: seeds is missing; write for instance seeds = \"1-30\"\n"
            "c.toml: line 1: this version of Rehearse reads format = 1");
  EXPECT_TRUE(complaint("format = 1\nseeds = [\n").starts_with("c.toml: line "));
  EXPECT_EQ(complaint(R"(format = 1
scenario = "line"
learners = ["echo", "eco"]
priors = ["near", "nowhere", "near"]
seeds = "3-1"
trials = 0
[set]
search.stop = 1
noise = -1
prior.gain = "much"
[learner.echo-alone]
search.step = 1
[vary]
breaks = [true, true]
search.step = 0.5
)"),
            "c.toml: line 3: unknown learner 'eco', did you mean 'echo'? (known: echo, echo-alone)\n"
            "c.toml: line 4: priors names 'near' twice\n"
            "c.toml: line 4: unknown prior 'nowhere' of scenario line (known: near, far, oracle)\n"
            "c.toml: line 5: seeds = \"3-1\", the first must not be above the last\n"
            "c.toml: line 6: trials = 0, must be between 1 and 1000000\n"
            "c.toml: line 8: unknown option 'search.stop', did you mean 'search.step'?\n"
            "c.toml: line 9: noise = -1, must be ≥ 0\n"
            "c.toml: line 10: prior.gain = much, must be a number\n"
            "c.toml: line 11: [learner.echo-alone] is none of the learners (echo, eco)\n"
            "c.toml: line 14: breaks has the value true twice\n"
            "c.toml: line 15: search.step must be a list of values in [vary]");
}

TEST(CampaignFile, AScenarioThatIsNoTextIsSaidOnce) {
  const std::string rest = "learners = \"echo\"\nseeds = 1\n";
  EXPECT_EQ(complaint("format = 1\nscenario = 3\n" + rest), "c.toml: line 2: scenario must be text in quotes");
  EXPECT_EQ(complaint("format = 1\nscenario = \"\"\n" + rest), "c.toml: scenario is missing");
  EXPECT_EQ(complaint("format = 1\n" + rest), "c.toml: scenario is missing");
}

TEST(CampaignFile, AClaimNamesALearner) {
  for (const std::string learner : {"", "learner = \"\"\n"})
    EXPECT_EQ(complaint("format = 1\nscenario = \"line\"\nlearners = \"echo\"\nseeds = 1\n[[claim]]\ntext = \"t\"\n" +
                        learner + "solved_by = 1\nat_least_runs = 1\n"),
              "c.toml: line 5: the claim names no learner");
}

TEST(CampaignFile, SaysWhatIsWrongWithVariantsAndDraws) {
  EXPECT_EQ(complaint(R"(format = 1
scenario = "line"
learners = ["echo"]
seeds = [4]
[draw]
noise = [1]
prior.gain = [2, 1]
search.stop = [0, 1]
[[variant]]
name = "a b"
[[variant]]
set.search.stop = 1
[[variant]]
name = "c"
ste.search.step = 1
[[variant]]
name = "c"
)"),
            "c.toml: line 6: noise must be [LOW, HIGH] in [draw], LOW below HIGH\n"
            "c.toml: line 7: prior.gain must be [LOW, HIGH] in [draw], LOW below HIGH\n"
            "c.toml: line 8: unknown option 'search.stop', did you mean 'search.step'?\n"
            "c.toml: line 9: the variant's name 'a b' must be of letters, digits and . _ + - alone\n"
            "c.toml: line 11: the variant has no name\n"
            "c.toml: line 12: unknown option 'search.stop', did you mean 'search.step'?\n"
            "c.toml: line 15: unknown key 'ste' in [[variant]], did you mean 'set'? (known: name, preset, set)\n"
            "c.toml: line 16: there are two variants 'c'");
  EXPECT_EQ(complaint(kHead + "learners = [\"echo\"]\n[draw]\nnoise = [-2, -1]\n"),
            "c.toml: line 7: noise = -1.0530104217580396, must be ≥ 0");
}

}  // namespace
}  // namespace rehearse::campaign
