#include "rehearse/campaign/planner.hpp"

#include <gtest/gtest.h>

#include "plans.hpp"

namespace rehearse::campaign {
namespace {

using plans::complaint, plans::kHead, plans::plan_of;

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

TEST(CampaignPlan, NeedsAPlant) {
  const auto none = experiment::fake::catalogue_with([](const auto&) { return experiment::fake::MakePlant(); });
  const std::string said = experiment::fake::message_of<InvalidInput>([&] {
    plan_campaign(none, "format = 1\nscenario = \"line\"\nlearners = \"echo\"\nseeds = \"1-3\"\n", "few.toml");
  });
  EXPECT_EQ(said, "few.toml: line 2: line has no plant, which runs need (in a file [plant])");
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
            "c.toml: line 6: unknown preset 'brave' (known: bold, careful); a file is named with "
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

}  // namespace
}  // namespace rehearse::campaign
