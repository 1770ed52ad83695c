#include "rehearse/experiment/resolve.hpp"

#include <gtest/gtest.h>

#include "specs.hpp"

namespace rehearse::experiment {
namespace {

using specs::complaint, specs::Options, specs::spec_of;

TEST(Spec, LearnerTakesTheScenariosFirstPriorByDefault) {
  const Resolved resolved = resolve(fake::catalogue(), spec_of("echo", ""));
  EXPECT_EQ(resolved.spec.prior, "near");
  EXPECT_EQ(resolved.prior->space[0].value, 1.2);
}

TEST(Spec, IsCompleteOnceResolved) {
  const Spec spec = resolve(fake::catalogue(), spec_of("echo", "far", {{"noise", "0.5"}, {"prior.gain", "2"}})).spec;
  const Options expected = {{"scenario.plant.gain", "1"},  {"scenario.noise", "0.5"},      {"scenario.breaks", "false"},
                            {"scenario.evaluations", "0"}, {"learner.search.step", "0.4"}, {"prior.gain", "2"},
                            {"prior.drift", "0"}};
  EXPECT_EQ(spec.options, expected);
}

TEST(Spec, OptionsReachScenarioLearnerAndPrior) {
  const Resolved resolved =
      resolve(fake::catalogue(),
              spec_of("echo", "near", {{"search.step", "2"}, {"scenario.noise", "0"}, {"prior.drift", "1"}}));
  EXPECT_EQ(resolved.spec.options[1].second, "0");
  EXPECT_EQ(resolved.spec.options[4].second, "2");
  EXPECT_EQ(resolved.prior->space[1].value, 1);
}

TEST(Spec, DefaultsOfAScenarioComeBeforeTheUsersOptions) {
  Catalogue catalogue = fake::catalogue();
  catalogue.default_presets = {{"line",
                                "format = 1\n[[for]]\nlearners = ['echo']\nset.search.step = 0.5\n"
                                "[[for]]\nlearners = ['echo-alone']\nset.of.others = 1\n"},
                               {"other", "no TOML"}};
  const std::pair<std::string, std::string> known{"learner.search.step", "0.5"}, wanted{"learner.search.step", "2"};
  EXPECT_EQ(resolve(catalogue, spec_of("echo", "near")).spec.options[4], known);
  EXPECT_EQ(resolve(catalogue, spec_of("echo", "near", {{"search.step", "2"}})).spec.options[4], wanted);
  EXPECT_EQ(fake::message_of<InvalidInput>([&] { resolve(catalogue, spec_of("echo-alone", "")); }),
            "presets/defaults/line.toml: line 7: unknown option 'of.others': `list` of a robot or learner names all, "
            "in Python `rehearse.options`");
}

/// A robot whose plant has what its oracle lacks, and a prior without anything to tune.
struct StiffBuilder : fake::LineBuilder {
  scenario::Scenario build() const override {
    scenario::Scenario scenario = LineBuilder::build();
    scenario.priors[1].parameters = scenario.priors[1].parameters.fixed_at(scenario.priors[1].parameters.values());
    scenario.oracle_lacks = {"v is late"};
    return scenario;
  }
};

/// The same robot, whose episodes may end early.
struct FallingBuilder final : StiffBuilder {
  scenario::Scenario build() const override {
    scenario::Scenario scenario = StiffBuilder::build();
    scenario.task.ended = each_state([](const ConstVectorView&) { return false; });
    return scenario;
  }
};

struct TuningBuilder final : fake::EchoBuilder {
  TuningBuilder() : EchoBuilder(true, {}) {}
  std::string name() const override { return "tuning"; }
  bool tunes_prior() const override { return true; }
  std::vector<std::string> warnings(const Task& task) const override {
    return task.ended ? std::vector<std::string>{"it ignores `ended`"} : std::vector<std::string>{};
  }
};

TEST(Spec, WarnsOfWhatIsHardlyMeant) {
  Catalogue catalogue = fake::catalogue();
  catalogue.scenarios = {{"line", [] { return std::make_unique<StiffBuilder>(); }}};
  catalogue.learner_families.emplace_back([] {
    std::vector<std::unique_ptr<learners::LearnerBuilder>> family;
    family.push_back(std::make_unique<TuningBuilder>());
    return family;
  });
  const auto warnings = [&](const std::string& learner, const std::string& prior) {
    return resolve(catalogue, spec_of(learner, prior)).warnings;
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(warnings("tuning", "near"), Lines{});
  EXPECT_EQ(warnings("tuning", "far"), Lines{"prior far has nothing to tune, so tuning learns no parameters"});
  EXPECT_EQ(warnings("tuning", "near,far"), Lines{});
  EXPECT_EQ(warnings("echo", "far"), Lines{});
  EXPECT_EQ(warnings("echo", "oracle"), Lines{"the oracle is not all of the plant: v is late"});
  EXPECT_EQ(warnings("tuning", "oracle"), Lines{"the oracle is not all of the plant: v is late"});
  catalogue.scenarios = {{"line", [] { return std::make_unique<FallingBuilder>(); }}};
  EXPECT_EQ(warnings("tuning", "near"), Lines{"tuning: it ignores `ended`"});
  EXPECT_EQ(warnings("echo", "near"), Lines{});
}

/// A learner that prefers two options of the scenario, of which this one has one, and a value that it cannot have.
class Choosy final : public fake::EchoBuilder {
 public:
  Choosy() : EchoBuilder(true, {}) {}
  learners::OptionTexts scenario_defaults() const override {
    return {{"noise", "0.3"}, {"policy", "rbf"}, {"evaluations", "-1"}, {"search.step", "9"}};
  }
};

TEST(Spec, WhatALearnerPrefersOfAScenarioComesBeforeAllElse) {
  Catalogue catalogue = fake::catalogue();
  catalogue.learner_families = {[] {
    std::vector<std::unique_ptr<learners::LearnerBuilder>> family;
    family.push_back(std::make_unique<Choosy>());
    return family;
  }};
  const auto noise = [&](const Options& options) {
    return resolve(catalogue, spec_of("echo", "near", options)).spec.options[1].second;
  };
  EXPECT_EQ(noise({}), "0.3");
  EXPECT_EQ(noise({{"noise", "0.5"}}), "0.5");
  const Options complete = resolve(catalogue, spec_of("echo", "near")).spec.options;
  EXPECT_EQ(complete[3].second, "0");    // evaluations
  EXPECT_EQ(complete[4].second, "0.4");  // search.step, which is the learner's own
  catalogue.default_presets = {{"line", "format = 1\nset.noise = 0.4\n"}};
  EXPECT_EQ(noise({}), "0.4");
}

/// The line of a robot's file that says how large the noise is.
struct StatedLine final : fake::LineBuilder {
  std::vector<std::string> stated() const override { return {"noise"}; }
};

TEST(Spec, WhatARobotsFileSaysComesBeforeWhatALearnerPrefers) {
  Catalogue catalogue = fake::catalogue();
  catalogue.scenarios = {{"line", [] { return std::make_unique<StatedLine>(); }}};
  catalogue.learner_families = {[] {
    std::vector<std::unique_ptr<learners::LearnerBuilder>> family;
    family.push_back(std::make_unique<Choosy>());
    return family;
  }};
  EXPECT_EQ(resolve(catalogue, spec_of("echo", "near")).spec.options[1].second, "0.01");
}

/// A learner with options that contradict each other.
class Contradictory final : public fake::EchoBuilder {
 public:
  Contradictory() : EchoBuilder(true, {}) {}
  void fields(FieldVisitor& v) override {
    EchoBuilder::fields(v);
    v.require(false, "search.step = 0.4, must be ≤ another");
  }
};

TEST(Spec, OptionsThatContradictEachOtherAreNoHindranceToLookingAtARun) {
  Catalogue catalogue = fake::catalogue();
  catalogue.learner_families = {[] {
    std::vector<std::unique_ptr<learners::LearnerBuilder>> family;
    family.push_back(std::make_unique<Contradictory>());
    return family;
  }};
  EXPECT_EQ(fake::message_of<InvalidInput>([&] { resolve(catalogue, spec_of("echo", "near")); }),
            "search.step = 0.4, must be ≤ another");
  EXPECT_NO_THROW(resolve_begun(catalogue, spec_of("echo", "near")));
}

TEST(Spec, SaysWhatIsWrong) {
  EXPECT_EQ(complaint({.scenario = "lime", .learner = "eco"}),
            "unknown scenario 'lime', did you mean 'line'? (known: line)\n"
            "unknown learner 'eco', did you mean 'echo'? (known: echo, echo-alone)");
  EXPECT_EQ(complaint(spec_of("eco", "nera", {{"scenario.noise", "-1"}, {"search.step", "1"}})),
            "unknown learner 'eco', did you mean 'echo'? (known: echo, echo-alone)\n"
            "noise = -1, must be ≥ 0\n"
            "unknown prior 'nera' of scenario line, did you mean 'near'? (known: near, far, oracle)");
  EXPECT_EQ(complaint({.scenario = "hexapod", .learner = "echo"}),
            "scenario 'hexapod' is not built: DART 6.12 was not found");
  EXPECT_EQ(complaint({.scenario = "line"}), "no learner is named (known: echo, echo-alone)");
  EXPECT_EQ(complaint(spec_of("echo", "nera")),
            "unknown prior 'nera' of scenario line, did you mean 'near'? (known: near, far, oracle)");
  EXPECT_EQ(complaint(spec_of("echo", "near,near")), "prior 'near' is named twice");
  EXPECT_EQ(complaint(spec_of("echo-alone", "near")), "learner echo-alone takes no prior, but 'near' is given");
  EXPECT_EQ(complaint(spec_of("echo", "", {{"serch.step", "1"}})),
            "unknown option 'serch.step', did you mean 'search.step'?");
  EXPECT_EQ(complaint(spec_of("echo", "", {{"prior.gian", "1"}})),
            "unknown option 'prior.gian', did you mean 'prior.gain'?");
  EXPECT_EQ(complaint(spec_of("echo", "", {{"prior.gain", "9"}})), "prior near: gain = 9, must be between 0.1 and 4");
}

TEST(Spec, NamesAllViolationsAtOnce) {
  Spec spec = spec_of("echo", "", {{"noise", "-1"}, {"search.step", "fast"}, {"colour", "red"}});
  spec.trials = -3;
  EXPECT_EQ(complaint(spec),
            "trials = -3, must be between 0 and 1000000\n"
            "noise = -1, must be ≥ 0\n"
            "search.step = fast, must be a number\n"
            "unknown option 'colour': `list` of a robot or learner names all, in Python `rehearse.options`");
}

/// The line, without a word on what is solved.
class Unsolvable final : public fake::LineBuilder {
 public:
  scenario::Scenario build() const override {
    scenario::Scenario line = fake::LineBuilder::build();
    line.task.solved = {};
    return line;
  }
};

TEST(Spec, UntilSolvedNeedsATaskThatSaysWhatThatIs) {
  Catalogue catalogue = fake::catalogue();
  catalogue.scenarios = {{"line", [] { return std::make_unique<Unsolvable>(); }}};
  Spec spec = spec_of("echo", "");
  spec.until_solved = true;
  EXPECT_EQ(fake::message_of<InvalidInput>([&] { resolve(catalogue, spec); }),
            "until_solved: line cannot say what is solved");
}

TEST(Resolve, LearnersAreNamedByDefault) {
  const Catalogue catalogue = fake::catalogue();
  EXPECT_EQ(default_learner(catalogue, {.scenario = "line"}), "gp-mi");
  EXPECT_EQ(default_learner(catalogue, {.scenario = "nothing"}), "gp-mi") << "what is wrong is the robot's name";
}

}  // namespace
}  // namespace rehearse::experiment
