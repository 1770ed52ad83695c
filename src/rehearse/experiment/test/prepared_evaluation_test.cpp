#include "rehearse/experiment/prepared_evaluation.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/exported_policy.hpp"
#include "rehearse/scenario/ode_scenario.hpp"

namespace rehearse::experiment {
namespace {

using fake::line_spec;

PreparedEvaluation prepared_of(const EvaluationRequest& request) {
  return prepare_evaluation(read_run(fake::catalogue(), request.folder), request);
}

/// A run of two trials, of a seed other than a plan's default.
std::filesystem::path line_folder(const std::string& learner = "echo") {
  std::filesystem::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(2, learner), folder, {});
  return folder;
}

TEST(PreparedEvaluation, HasTheBestPolicyAndTheSeedOfTheRun) {
  const std::filesystem::path folder = line_folder();
  const PastRun run = read_run(fake::catalogue(), folder);
  const PreparedEvaluation prepared = prepared_of({.folder = folder});
  EXPECT_EQ(prepared.policy.learned.trial, run.trial({}).trial);
  EXPECT_EQ(prepared.policy.learned.theta, run.trial({}).theta);
  EXPECT_EQ(prepared.policy.total_reward, run.trial({}).total_reward);
  EXPECT_EQ(prepared.request.plan.seed, 3);
  EXPECT_FALSE(prepared.told);
  const PreparedEvaluation first =
      prepared_of({.folder = folder, .trial = 1, .plan = {.seed = 8}, .seed_of_run = false});
  EXPECT_EQ(first.policy.learned.theta, run.trial(1).theta);
  EXPECT_EQ(first.request.plan.seed, 8);
}

TEST(PreparedEvaluation, MayHaveAnotherPolicyAndOtherSettings) {
  const std::filesystem::path folder = line_folder("echo-alone");  // whose first policy, a schedule, can be exported
  const std::string file = policy::to_json(exported_policy(read_run(fake::catalogue(), folder), 1));
  const PreparedEvaluation prepared =
      prepared_of({.folder = folder, .policy = file, .settings = {{"noise", "0.5"}, {"plant.gain", "2"}}});
  EXPECT_EQ(prepared.policy.learned.trial, 1);
  EXPECT_EQ(prepared.about().settings, "noise=0.5 plant.gain=2");
  const auto& options = prepared.resolved.spec.options;
  EXPECT_TRUE(std::ranges::count(options, std::pair<std::string, std::string>("scenario.noise", "0.5")));
  EXPECT_DOUBLE_EQ(prepared.about().seconds, prepared.resolved.scenario.task.episode_s());
  const auto all = robustness(prepared, serial_evaluator());
  ASSERT_EQ(all.size(), kFactors.size());
  EXPECT_EQ(all.front().value, 2 * kFactors.front()) << "of what is set";
  EXPECT_EQ(all[2].summary.returns, summary_of(evaluate(prepared, serial_evaluator())).returns);
}

TEST(PreparedEvaluation, SaysWhatIsWrong) {
  const std::filesystem::path folder = line_folder();
  const auto said = [&](const EvaluationRequest& request) {
    return fake::message_of<InvalidInput>([&] { prepared_of(request); });
  };
  EXPECT_NE(said({.folder = folder / "none"}).find("is not a folder"), std::string::npos);
  EXPECT_NE(said({.folder = folder, .trial = 7}).find("trial = 7"), std::string::npos);
  EXPECT_EQ(said({.folder = folder, .policy = "[]", .policy_source = "it.json"}),
            "it.json is no policy that `export` wrote as JSON");
  EXPECT_NE(said({.folder = folder, .settings = {{"nois", "1"}}}).find("nois"), std::string::npos);
  const PastRun run = read_run(fake::catalogue(), folder);
  Violations before;
  before.add("episodes = 0");
  EXPECT_TRUE(fake::message_of<InvalidInput>([&] {
                prepare_evaluation(run, {.folder = folder, .trial = 7}, before);
              }).starts_with("episodes = 0\ntrial = 7"));
}

TEST(PreparedEvaluation, SettingsThatChangeNoEpisodeAreRefused) {
  const std::filesystem::path folder = line_folder();
  const std::string known = "; what can be set: plant.gain, noise, breaks";
  const auto said = [&](const learners::OptionTexts& settings) {
    return fake::message_of<InvalidInput>([&] { prepared_of({.folder = folder, .settings = settings}); });
  };
  const std::string of_learner = " changes no episode: it is an option of the learner" + known;
  EXPECT_EQ(said({{"prior.gain", "0.7"}, {"search.step", "1"}, {"learner.search.step", "1"}, {"told_by", "measured"}}),
            "prior.gain changes no episode: no prior plays the robot" + known + "\nsearch.step" + of_learner +
                "\nlearner.search.step" + of_learner + "\ntold_by changes no episode: it is an option of learning" +
                known);
  PastRun run = read_run(fake::catalogue(), folder);
  run.resolved.scenario.make_plant = nullptr;  // so that the prior plays
  const PreparedEvaluation prepared =
      prepare_evaluation(run, {.folder = folder, .settings = {{"scenario.noise", "0"}, {"prior.gain", "0.7"}}});
  EXPECT_NE(prepared.about().settings.find("scenario.noise=0 prior.gain=0.7"), std::string::npos);
  EXPECT_EQ(prepared.resolved.prior->space.values()(0), 0.7);
}

/// The catalogue whose robot has the fields `more`, too.
Catalogue catalogue_with(const Fields& more) {
  struct WithMore final : fake::LineBuilder {
    explicit WithMore(Fields fields) : more_(std::move(fields)) {}
    void fields(FieldVisitor& v) override {
      LineBuilder::fields(v);
      more_(v);
    }
    Fields more_;
  };
  Catalogue catalogue = fake::catalogue();
  catalogue.scenarios = {{"line", [more] { return std::make_unique<WithMore>(more); }}};
  return catalogue;
}

TEST(PreparedEvaluation, OptionsOfPoliciesAndPriorsAreRefused) {
  scenario::OdeOptions options;
  Index substeps = 1;
  const Catalogue catalogue = catalogue_with([&](FieldVisitor& v) {
    v.integer("substeps", substeps, "of priors");
    v.number("box_high", options.box_high, "of parameters that are learned");
    options.policy.fields(v);
  });
  const std::filesystem::path folder = fake::test_folder() / "run";
  start_run(catalogue, line_spec(1), folder, {});
  const auto said = [&](const learners::OptionTexts& settings, bool prior_plays) {
    PastRun run = read_run(catalogue, folder);
    if (prior_plays) run.resolved.scenario.make_plant = nullptr;
    return fake::message_of<InvalidInput>([&] { prepare_evaluation(run, {.folder = folder, .settings = settings}); });
  };
  const std::string known = "; what can be set: plant.gain, noise, breaks";
  EXPECT_EQ(said({{"substeps", "3"}, {"scenario.box_high", "3"}}, false),
            "substeps changes no episode: it is an option of priors, and none plays the robot" + known +
                "\nscenario.box_high changes no episode: it is an option of learning" + known);
  EXPECT_EQ(said({{"substeps", "3"}}, true), "");
  EXPECT_EQ(said({{"hidden", "3"}}, false),
            "hidden changes no episode: it is an option of the policy, which stays as it was learned; what can be set: "
            "plant.gain, noise, breaks");
}

TEST(PreparedEvaluation, SettingsThatContradictTheRobotAreRefused) {
  double ignored = 0;
  bool newer = false;
  const Catalogue catalogue = catalogue_with([&](FieldVisitor& v) {
    v.number("ignored", ignored, "must be 0");
    v.require(ignored == 0, "ignored: the plant measures by itself");
    v.require(!newer, "noise: another condition, which is newer than the run");
  });
  const std::filesystem::path folder = fake::test_folder() / "run";
  start_run(catalogue, line_spec(1), folder, {});
  newer = true;
  const PastRun run = read_run(catalogue, folder);
  EXPECT_NO_THROW(prepare_evaluation(run, {.folder = folder})) << "what the run has already is no hindrance";
  EXPECT_EQ(fake::message_of<InvalidInput>([&] {
              prepare_evaluation(run, {.folder = folder, .settings = {{"ignored", "0.1"}}});
            }),
            "ignored: the plant measures by itself");
}

TEST(PreparedEvaluation, TheRobotsFileIsReadOnceForAnEvaluation) {
  int reads = 0;
  Catalogue catalogue = fake::catalogue();
  catalogue.scenarios.clear();
  catalogue.read_robot = [&reads](std::string_view, const std::string&, const auto&) {
    ++reads;
    return [] { return std::make_unique<fake::LineBuilder>(); };
  };
  const std::filesystem::path folder = fake::test_folder() / "run";
  const Catalogue with_line = catalogue.with_robot("a line", "line.toml", "");
  start_run(with_line, line_spec(1), folder, {});
  EXPECT_EQ(reads, 1);
  const PreparedEvaluation prepared = prepare_evaluation(read_run(catalogue, folder), {.folder = folder});
  robustness(prepared, serial_evaluator());
  EXPECT_EQ(reads, 2);
  read_run(with_line, folder);
  EXPECT_EQ(reads, 2) << "it was read before";
}

}  // namespace
}  // namespace rehearse::experiment
