#include "rehearse/experiment/trial_record.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

using fake::line_spec, fake::lines_of;

TrialRecord record_of(Index trial, const learners::Proposal& proposal, const Episode& episode,
                      const Resolved& resolved) {
  TrialRecord record = record_before(trial, proposal, resolved);
  add_outcome(record, episode, resolved.scenario.task);
  return record;
}

TEST(TrialRecord, HasTheTunableParametersAndWhatCameOfTheTrial) {
  const Resolved resolved = resolve(fake::catalogue(), line_spec(1));
  learners::Proposal proposal;
  proposal.policy = resolved.scenario.policy;
  proposal.theta = Vector{{-0.4, 0.1}};
  proposal.phi = Vector{{1.3, 7}};
  proposal.posterior = {{resolved.prior->space[0]}, Vector{{1.3}}, Matrix{{0.01}}};
  Episode episode{.states = Matrix::Zero(13, 1), .true_states = Matrix::Zero(13, 1), .actions = Matrix::Zero(12, 1)};
  episode.rewards = Vector::Constant(12, 0.5);
  episode.charged = -1;
  episode.failure = "it fell";
  const TrialRecord record = record_of(4, proposal, episode, resolved);
  EXPECT_EQ(record.trial, 4);
  EXPECT_EQ(record.total_reward, 5);
  EXPECT_EQ(record.solved, true);
  EXPECT_EQ(record.policy, "line");
  EXPECT_EQ(record.theta, proposal.theta);
  EXPECT_EQ(record.phi, std::vector<double>{1.3}) << "the drift is fixed";
  ASSERT_TRUE(record.phi_intervals.at(0));
  EXPECT_NEAR(record.phi_intervals[0]->low, 1.104, 1e-3);
  EXPECT_NEAR(record.phi_intervals[0]->high, 1.496, 1e-3);
  EXPECT_EQ(record.notes, std::vector<std::string>{"the episode ended at the reward floor: it fell"});
  EXPECT_TRUE(record.forecast.empty()) << "there is no model";
}

TEST(TrialRecord, NotesSayWhereThePriorFailed) {
  const Resolved resolved = resolve(fake::catalogue(), line_spec(1));
  learners::Proposal proposal;
  proposal.policy = resolved.scenario.policy;
  proposal.rollouts = 100, proposal.failed_rollouts = 10;
  EXPECT_EQ(record_before(1, proposal, resolved).notes, std::vector<std::string>{});
  proposal.failed_rollouts = 51, proposal.left_out_rows = 19;
  EXPECT_EQ(record_before(2, proposal, resolved).notes,
            (std::vector<std::string>{
                "19 training rows left out: a change, or the prior's prediction of it, was not finite",
                "51 of 100 rollouts failed: the model's predictions, or their rewards, were not finite"}));
  proposal.failed_row = "in x = 7 under u = 1: no licence";
  EXPECT_EQ(record_before(2, proposal, resolved).notes.back(),
            "51 of 100 rollouts failed: the prior fails in x = 7 under u = 1: no licence");
}

TEST(TrialRecord, SaysOfEachLimitWhatWasExpectedAndWhatHappened) {
  Resolved resolved = resolve(fake::catalogue(), line_spec(1));
  resolved.scenario.task.limits = {{.name = "end", .risk = 0.05}, {.name = "speed", .risk = 0.01}};
  learners::Proposal proposal;
  proposal.policy = resolved.scenario.policy;
  Episode episode{.states = Matrix::Zero(13, 1), .true_states = Matrix::Zero(13, 1), .actions = Matrix::Zero(12, 1)};
  episode.rewards = Vector::Zero(12);
  episode.broken_limits = {"speed"};
  for (const LimitRecord& unknown : record_before(1, proposal, resolved).limits) {
    EXPECT_FALSE(unknown.predicted);
    EXPECT_FALSE(unknown.safe());
  }
  proposal.risks = {{4, 400}, {4, 400}};
  const auto limits = record_of(1, proposal, episode, resolved).limits;
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_EQ(limits[0].limit, "end");
  EXPECT_EQ(limits[0].predicted, 0.01);
  EXPECT_LT(limits[0].interval.low, 0.01);
  EXPECT_GT(limits[0].interval.high, 0.01);
  EXPECT_TRUE(limits[0].safe());
  EXPECT_FALSE(limits[1].safe());
  EXPECT_FALSE(limits[0].broken);
  EXPECT_TRUE(limits[1].broken);
}

TEST(TrialRecord, OfALearnerWithoutPriorHasNoModelColumns) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(2, "echo-alone"), folder, {});
  const auto trials = lines_of(folder / "trials.csv");
  EXPECT_EQ(trials[0], "trial,interaction_s,return,solved,predicted_return,rollouts,failed_rollouts,log_evidence");
  EXPECT_TRUE(trials[1].ends_with(",,100,0,")) << trials[1];
  EXPECT_TRUE(fs::is_empty(folder / "predictions"));
}

TEST(TrialRecord, AnEndThatNoModelKnowsIsSaidInTheNotes) {
  Resolved resolved = resolve(fake::catalogue(), line_spec(1));
  learners::Proposal proposal;
  proposal.policy = resolved.scenario.policy;
  Episode episode{.states = Matrix::Zero(4, 1), .true_states = Matrix::Zero(4, 1), .actions = Matrix::Zero(3, 1)};
  episode.rewards = Vector::Zero(3);
  episode.ended = true;
  resolved.scenario.task.ended = nullptr;
  EXPECT_EQ(
      record_of(1, proposal, episode, resolved).notes,
      std::vector<std::string>{"the robot itself ended the episode in step 3, which no simulated episode knows: say "
                               "when it ends by `ended`, or by a limit"});
  resolved.scenario.task.ended = each_state([](const ConstVectorView&) { return true; });
  EXPECT_TRUE(record_of(1, proposal, episode, resolved).notes.empty());
}

TEST(TrialRecord, AnEpisodeThatFailsIsSaidInTheNotes) {
  const fs::path folder = fake::test_folder();
  Catalogue catalogue = fake::catalogue();
  /// The line, whose reward is no number.
  class Faulty final : public fake::LineBuilder {
   public:
    scenario::Scenario build() const override {
      scenario::Scenario scenario = LineBuilder::build();
      scenario.task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&,
                                VectorView rewards) { rewards.setConstant(std::nan("")); };
      return scenario;
    }
  };
  catalogue.scenarios = {{"line", [] { return std::make_unique<Faulty>(); }}};
  start_run(catalogue, line_spec(2), folder / "run", {});
  const auto notes = lines_of(folder / "run/notes.csv");
  for (const std::string trial : {"1", "2"})
    EXPECT_EQ(std::count(notes.begin(), notes.end(),
                         trial + ",the episode ended at the reward floor: the reward at step 1 is not finite"),
              1);
  EXPECT_EQ(files::read_file(folder / "run/trials.csv").find("nan"), std::string::npos);
}

}  // namespace
}  // namespace rehearse::experiment
