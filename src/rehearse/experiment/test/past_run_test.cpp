#include "rehearse/experiment/past_run.hpp"

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/ask_tell.hpp"
#include "rehearse/experiment/run_folder.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

using fake::line_spec, fake::message_of;

TEST(PastRun, HasTheTrialsOfItsFolder) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(3), folder, {});
  const RunFolder at_work = RunFolder::open(folder);  // which has the lock
  const PastRun run = read_run(fake::catalogue(), folder);
  EXPECT_EQ(run.history.done(), 3);
  EXPECT_EQ(run.resolved.spec.learner, "echo");
  EXPECT_EQ(run.trial(2).trial, 2);
  for (const TrialRecord& trial : run.history.trials) EXPECT_GE(run.trial({}).total_reward, trial.total_reward);
  EXPECT_EQ(message_of<InvalidInput>([&] { run.trial(4); }),
            "trial = 4, must be between 1 and 3, the trials that are done");
  EXPECT_THROW(run.trial(0), InvalidInput);
}

TEST(PastRun, HasTheTrialThatIsAskedFor) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(0), folder, {});
  EXPECT_EQ(message_of<InvalidInput>([&] { read_run(fake::catalogue(), folder).trial({}); }), "no trial is done yet");
  const AskResult asked = ask_run(fake::catalogue(), folder, {});
  const PastRun run = read_run(fake::catalogue(), folder);
  EXPECT_EQ(run.trial(1).theta, asked.trial.theta);
  for (const std::optional<Index> number : {std::optional<Index>(), std::optional<Index>(2)})
    EXPECT_EQ(message_of<InvalidInput>([&] { run.trial(number); }),
              "no trial is done yet; trial 1 is asked for, --trial 1 (in Python trial=1)");
}

TEST(PastRun, TheNewestModelIsWhatPlaysARobotWithoutAPlant) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(2), folder, {});
  PastRun run = read_run(fake::catalogue(), folder);
  EXPECT_TRUE(run.as_identified().empty()) << "it has a plant";
  run.resolved.scenario.make_plant = nullptr;
  ASSERT_TRUE(run.resolved.prior && run.resolved.prior->space.has_tunable());
  run.history.trials.back().phi = {0.25};
  using Settings = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(run.as_identified(), (Settings{{"prior.gain", "0.25"}}));
  EXPECT_EQ(run.as_identified({{"noise", "0.5"}}), (Settings{{"prior.gain", "0.25"}, {"noise", "0.5"}}));
  for (const std::string gain : {"prior.gain", "prior.near.gain"})
    EXPECT_EQ(run.as_identified({{gain, "3"}}), (Settings{{gain, "3"}})) << "a parameter has one value";
  run.history.asked = run.history.trials.back();
  run.history.asked->phi = {0.75};
  EXPECT_EQ(run.as_identified(), (Settings{{"prior.gain", "0.75"}})) << "that of the trial that is asked for";
  run.history = {};
  EXPECT_TRUE(run.as_identified().empty()) << "nothing is identified";
}

TEST(PastRun, PoliciesAreThoseOfTheirTrials) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(2, "echo-alone"), folder, {});
  const PastRun run = read_run(fake::catalogue(), folder);
  EXPECT_EQ(policy_of(run.trial(1), run.resolved.scenario)->name(), "schedule");
  EXPECT_EQ(policy_of(run.trial(2), run.resolved.scenario)->name(), "line");
  TrialRecord handing_over = run.trial(2);
  handing_over.policy = "hand-over";
  const auto elsewhere = run.resolved.scenario.policy;
  EXPECT_GT(policy_of(handing_over, run.resolved.scenario)->parameters(), elsewhere->parameters());
  TrialRecord unknown = run.trial(1);
  unknown.policy = "mlp";
  EXPECT_THROW(policy_of(unknown, run.resolved.scenario), InvalidInput);
}

TEST(PastRun, SaysWhatIsWrongWithAFolder) {
  const fs::path folder = fake::test_folder();
  const auto wrong = [&] { return message_of<InvalidInput>([&] { read_run(fake::catalogue(), folder / "run"); }); };
  EXPECT_NE(wrong().find("is not a folder"), std::string::npos) << wrong();
  fs::create_directory(folder / "run");
  EXPECT_NE(wrong().find("it has no spec.toml"), std::string::npos) << wrong();
  fs::remove(folder / "run");
  start_run(fake::catalogue(), line_spec(1), folder / "run", {});
  files::write_file(folder / "run/checkpoint", "damaged");
  EXPECT_NE(wrong().find("truncated"), std::string::npos) << wrong();
}

}  // namespace
}  // namespace rehearse::experiment
