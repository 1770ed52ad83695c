#include "rehearse/campaign/planner.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/test/fake.hpp"

namespace rehearse::campaign {
namespace {

const std::string kHead = "format = 1\nscenario = \"line\"\nseeds = [4, 2]\ntrials = 3\n";

CampaignPlan plan_of(const std::string& rest) {
  return plan_campaign(experiment::fake::catalogue(), kHead + rest, "c.toml");
}

std::string complaint(const std::string& text) {
  return experiment::fake::message_of<InvalidInput>(
      [&] { plan_campaign(experiment::fake::catalogue(), text, "c.toml"); });
}

std::string option(const PlannedRun& run, const std::string& key) {
  for (const auto& [name, text] : run.spec.options)
    if (name == key) return text;
  return "none";
}

std::vector<std::string> names_of(const CampaignPlan& plan) {
  std::vector<std::string> names;
  for (const PlannedRun& run : plan.runs) names.push_back(run.name);
  return names;
}

TEST(CampaignPlan, KeepsTheOrderOfTheFile) {
  const CampaignPlan plan = plan_of("learners = [\"echo-alone\", \"echo\"]\npriors = [\"far\", \"near\"]\n");
  EXPECT_EQ(names_of(plan),
            (std::vector<std::string>{"line-echo-alone-none-4", "line-echo-alone-none-2", "line-echo-far-4",
                                      "line-echo-far-2", "line-echo-near-4", "line-echo-near-2"}));
  ASSERT_EQ(plan.groups.size(), 3u);
  EXPECT_EQ(plan.groups[0].prior, "");
  EXPECT_EQ(plan.groups[1].prior, "far");
  EXPECT_EQ(plan.runs[3].spec.seed, 2);
  EXPECT_EQ(plan.runs[3].spec.trials, 3);
  EXPECT_EQ(plan.runs[3].group, 1u);
}

TEST(CampaignPlan, DefaultsAreTheFirstPriorTenTrialsAndTheFilesName) {
  const CampaignPlan plan =
      plan_campaign(experiment::fake::catalogue(),
                    "format = 1\nscenario = \"line\"\nlearners = \"echo\"\nseeds = \"5-7\"\n", "some/where.toml");
  EXPECT_EQ(plan.groups[0].prior, "near");
  EXPECT_EQ(plan.trials, 10);
  EXPECT_EQ(plan.seeds, (std::vector<Index>{5, 6, 7}));
  EXPECT_EQ(plan.title, "where");
}

TEST(CampaignPlan, OptionsReachTheRunsThatHaveThem) {
  const CampaignPlan plan = plan_of(R"(
    learners = ["echo", "echo-alone"]
    [set]
    search.step = 2
    prior.gain = 1.5
    [learner.echo-alone]
    search.step = 3
  )");
  EXPECT_EQ(option(plan.run(0, 0), "learner.search.step"), "2");
  EXPECT_EQ(option(plan.run(0, 0), "prior.gain"), "1.5");
  EXPECT_EQ(option(plan.run(1, 0), "learner.search.step"), "3");
}

TEST(CampaignPlan, PresetsComeBeforeWhatTheFileSets) {
  experiment::Catalogue catalogue = experiment::fake::catalogue();
  catalogue.presets = {{"bold", "format = 1\n[set]\nsearch.step = 5\nnoise = 2\n"},
                       {"careful", "format = 1\n[[for]]\nlearners = [\"echo\"]\nset.search.step = 0.1\n"}};
  const auto plan_of = [&](const std::string& rest) { return plan_campaign(catalogue, kHead + rest, "c.toml"); };
  const CampaignPlan plan = plan_of(R"(
    learners = ["echo"]
    preset = "bold"
    [set]
    noise = 1
    [[variant]]
    name = "bold"
    [[variant]]
    name = "careful"
    preset = "careful"
    [[variant]]
    name = "own"
    preset = "careful"
    set.search.step = 7
  )");
  ASSERT_EQ(plan.groups.size(), 3u);
  const std::vector<std::string> steps = {"5", "0.1", "7"};
  for (std::size_t group = 0; group < 3; ++group) {
    EXPECT_EQ(option(plan.run(group, 0), "learner.search.step"), steps[group]);
    EXPECT_EQ(option(plan.run(group, 0), "scenario.noise"), "1");
  }
  EXPECT_EQ(plan.groups[1].options, (std::vector<std::pair<std::string, std::string>>{{"preset", "careful"}}));
  EXPECT_EQ(experiment::fake::message_of<InvalidInput>([&] {
              plan_of(
                  "learners = [\"echo\", \"echo-alone\"]\npreset = \"brave\"\n[[variant]]\nname = \"a\"\n"
                  "[[variant]]\nname = \"b\"\npreset = \"careful\"\n");
            }),
            "c.toml: line 6: unknown preset 'brave', did you mean 'bold'? (known: bold, careful); a file is named with "
            "its .toml");
  EXPECT_EQ(experiment::fake::message_of<InvalidInput>([&] {
              plan_of("learners = [\"echo\", \"echo-alone\"]\n[[variant]]\nname = \"b\"\npreset = \"careful\"\n");
            }),
            "c.toml: line 6: presets/careful.toml: nothing is set for learner echo-alone on scenario line");
}

TEST(CampaignPlan, VariesOptionsAndRunsOnceWhereThereIsNone) {
  const CampaignPlan plan = plan_of(R"(
    learners = ["echo", "echo-alone"]
    [vary]
    noise = [0, 0.5]
    prior.gain = [1, 2]
  )");
  ASSERT_EQ(plan.groups.size(), 6u);
  EXPECT_EQ(plan.groups[0].variant, "noise=0,prior.gain=1");
  EXPECT_EQ(plan.groups[1].variant, "noise=0,prior.gain=2");  // the last changes fastest
  EXPECT_EQ(plan.groups[3].variant, "noise=0.5,prior.gain=2");
  EXPECT_EQ(plan.groups[4].variant, "noise=0");
  EXPECT_EQ(plan.run(1, 0).name, "line-echo-near-noise=0,prior.gain=2-4");
  EXPECT_EQ(option(plan.run(1, 0), "prior.gain"), "2");
  EXPECT_EQ(option(plan.run(4, 0), "prior.gain"), "none");
}

TEST(CampaignPlan, NamedVariantsSetSeveralOptions) {
  const CampaignPlan plan = plan_of(R"(
    learners = ["echo", "echo-alone"]
    [vary]
    noise = [0, 0.5]
    [[variant]]
    name = "default"
    [[variant]]
    name = "bold"
    set.search.step = 2
    set.prior.gain = 1.5
  )");
  std::vector<std::string> variants;
  for (const CampaignGroup& group : plan.groups) variants.push_back(group.learner + " " + group.variant);
  EXPECT_EQ(variants, (std::vector<std::string>{"echo default,noise=0", "echo default,noise=0.5", "echo bold,noise=0",
                                                "echo bold,noise=0.5", "echo-alone default,noise=0",
                                                "echo-alone default,noise=0.5"}))
      << "a learner without a prior has not all options of the other";
  EXPECT_EQ(plan.run(2, 0).name, "line-echo-near-bold,noise=0-4");
  EXPECT_EQ(option(plan.run(2, 0), "learner.search.step"), "2");
  EXPECT_EQ(option(plan.run(2, 0), "prior.gain"), "1.5");
  EXPECT_NE(option(plan.run(0, 0), "prior.gain"), "1.5");
  EXPECT_EQ(plan.groups[2].options, (std::vector<std::pair<std::string, std::string>>{
                                        {"search.step", "2"}, {"prior.gain", "1.5"}, {"noise", "0"}}));
}

TEST(CampaignPlan, DrawsOptionsForEachSeed) {
  const std::string learners = "learners = [\"echo\", \"echo-alone\"]\n[draw]\n";
  const CampaignPlan plan = plan_of(learners + "prior.gain = [1, 1.5]\n");
  ASSERT_EQ(plan.groups.size(), 2u) << "seeds of one group differ";
  const std::string first = option(plan.run(0, 0), "prior.gain"), second = option(plan.run(0, 1), "prior.gain");
  EXPECT_NE(first, second);
  for (const std::string& text : {first, second}) {
    EXPECT_GE(std::stod(text), 1);
    EXPECT_LT(std::stod(text), 1.5);
  }
  EXPECT_EQ(option(plan.run(1, 0), "prior.gain"), "none");
  const CampaignPlan more = plan_of(learners + "noise = [0, 1]\nprior.gain = [1, 1.5]\n");
  EXPECT_EQ(option(more.run(0, 1), "prior.gain"), second) << "whatever else is drawn";
  EXPECT_EQ(option(more.run(0, 1), "scenario.noise"), option(more.run(1, 1), "scenario.noise"))
      << "whichever the learner";
}

TEST(CampaignPlan, SaysWhatIsWrongWithVariantsAndDraws) {
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

TEST(CampaignPlan, SeveralPriorsOfOneRunAndTheOracle) {
  const CampaignPlan plan = plan_of(R"(
    learners = ["echo"]
    priors = ["near,far", "oracle", "far"]
    [set]
    prior.gain = 2
    prior.far.drift = 0.5
  )");
  EXPECT_EQ(option(plan.run(0, 0), "prior.near.gain"), "2");
  EXPECT_EQ(option(plan.run(0, 0), "prior.far.drift"), "0.5");
  EXPECT_EQ(option(plan.run(0, 0), "prior.near.drift"), "0");
  EXPECT_EQ(option(plan.run(1, 0), "prior.gain"), "none");
  EXPECT_EQ(option(plan.run(2, 0), "prior.drift"), "0.5");
}

/// A learner that refuses every task until it is told to be ready.
class Hesitant final : public experiment::fake::EchoBuilder {
 public:
  Hesitant() : EchoBuilder(false, {}) {}
  std::string name() const override { return "hesitant"; }
  void fields(FieldVisitor& v) override {
    EchoBuilder::fields(v);
    v.boolean("ready", ready_, "whether it can be built");
  }
  std::vector<std::string> violations(const Task&, const policy::Policy& policy) const override {
    if (ready_) return {};
    return {"not ready for the policy " + policy.name()};
  }

 private:
  bool ready_ = false;
};

TEST(CampaignPlan, ALearnerRefusesWhatItIsGivenNotWhatItWouldBeWithoutOptions) {
  experiment::Catalogue catalogue = experiment::fake::catalogue();
  catalogue.learner_families.push_back([] {
    std::vector<std::unique_ptr<learners::LearnerBuilder>> family;
    family.push_back(std::make_unique<Hesitant>());
    return family;
  });
  const auto plan = [&](const std::string& options) {
    return plan_campaign(catalogue, kHead + "learners = [\"echo\", \"hesitant\"]\n" + options, "c.toml");
  };
  EXPECT_EQ(plan("[learner.hesitant]\nready = true\n").runs.size(), 4u);
  EXPECT_EQ(plan("[set]\nready = true\n").runs.size(), 4u);
  EXPECT_EQ(experiment::fake::message_of<InvalidInput>([&] { plan("[learner.hesitant]\nsearch.step = 2\n"); }),
            "c.toml: line 5: not ready for the policy line");
}

TEST(CampaignPlan, ALearnerThatIsNotBuiltIsMissing) {
  const CampaignPlan plan = plan_of("learners = [\"pilco\", \"echo\"]\n[learner.pilco]\ncentres = 200\n");
  ASSERT_EQ(plan.missing.size(), 1u);
  EXPECT_EQ(plan.missing[0].name, "pilco");
  EXPECT_EQ(plan.missing[0].reason, "learner 'pilco' is not built: not written yet");
  EXPECT_EQ(plan.runs.size(), 2u);
}

TEST(CampaignPlan, FindsWhatClaimsAreAbout) {
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

TEST(CampaignPlan, ComparesRunsOfTheSameVariant) {
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

TEST(CampaignPlan, SaysAllThatIsWrongWithItsLine) {
  EXPECT_EQ(complaint("format = 2\n"),
            "c.toml: learners is missing\nc.toml: scenario is missing\n"
            "c.toml: seeds is missing; write for instance seeds = \"1-30\"\n"
            "c.toml: line 1: this version of Rehearse reads format = 1");
  EXPECT_TRUE(complaint("format = 1\nseeds = [\n").starts_with("c.toml: line "));
  EXPECT_EQ(
      complaint(R"(format = 1
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
      "c.toml: line 4: unknown prior 'nowhere' of scenario line, did you mean 'near'? (known: near, far, oracle)\n"
      "c.toml: line 5: seeds = \"3-1\", the first must not be above the last\n"
      "c.toml: line 6: trials = 0, must be between 1 and 1000000\n"
      "c.toml: line 8: unknown option 'search.stop', did you mean 'search.step'?\n"
      "c.toml: line 9: noise = -1, must be ≥ 0\n"
      "c.toml: line 10: prior.gain = much, must be a number\n"
      "c.toml: line 11: [learner.echo-alone] is none of the learners (echo, eco)\n"
      "c.toml: line 14: breaks has the value true twice\n"
      "c.toml: line 15: search.step must be a list of values in [vary]");
}

TEST(CampaignPlan, AScenarioThatIsNoTextIsSaidOnce) {
  const std::string rest = "learners = \"echo\"\nseeds = 1\n";
  EXPECT_EQ(complaint("format = 1\nscenario = 3\n" + rest), "c.toml: line 2: scenario must be text in quotes");
  EXPECT_EQ(complaint("format = 1\nscenario = \"\"\n" + rest), "c.toml: scenario is missing");
  EXPECT_EQ(complaint("format = 1\n" + rest), "c.toml: scenario is missing");
}

TEST(CampaignPlan, TooManyRunsAreRefusedBeforeTheyArePlanned) {
  std::string axes = "learners = [\"echo\"]\n[vary]\n";
  for (const std::string key : {"noise", "plant.gain", "search.step", "prior.gain", "prior.drift"}) {
    axes += key + " = [0";
    for (int i = 1; i < 100; ++i) axes += ", " + std::to_string(i);
    axes += "]\n";
  }
  EXPECT_EQ(complaint(kHead + axes), "c.toml: these are more than 100000 runs");
  EXPECT_EQ(
      complaint("format = 1\nscenario = \"line\"\nlearners = [\"echo\"]\nseeds = [\"1-60000\", \"100000-150000\"]\n"),
      "c.toml: these are more than 100000 runs");
}

TEST(CampaignPlan, EachRunHasAFolderOfItsOwnWithANameThatFits) {
  EXPECT_EQ(
      complaint("format = 1\nscenario = \"line\"\nlearners = [\"echo\"]\nseeds = [1]\npriors = [\"\", \"near\"]\n"),
      "c.toml: two runs would have the folder line-echo-near-1: they are the same but for what no name of a folder "
      "can tell");
  const std::string many(250, '0');
  EXPECT_NE(complaint(kHead + "learners = [\"echo\"]\n[vary]\nnoise = [\"0." + many + "1\"]\n")
                .find("c.toml: the name of a run's folder is longer than 240 bytes: line-echo-near-noise=0.00"),
            std::string::npos);
  EXPECT_EQ(complaint("format = 1\nscenario = \"\"\nlearners = [\"echo\"]\nseeds = [1]\n"),
            "c.toml: scenario is missing");
}

TEST(CampaignPlan, SaysWhatIsWrongWithClaims) {
  const auto about = [](const std::string& claim) {
    return complaint(kHead + "learners = [\"echo\"]\n[[claim]]\ntext = \"x\"\n" + claim);
  };
  const std::string success = "learner = \"echo\"\nsolved_by = 2\n";
  EXPECT_EQ(about(success), "c.toml: line 6: how many? at_least_runs, at_most_runs, at_least_rate or at_most_rate");
  EXPECT_EQ(about(success + "at_least_runs = 3\n"), "c.toml: line 6: at_least_runs = 3, but the claim is about 2 runs");
  EXPECT_EQ(about("learner = \"echo\"\nreached_by = 2\nat_most_runs = 2\n"),
            "c.toml: line 6: reached_by needs return_at_least");
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
