#include "rehearse/experiment/run.hpp"

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "wrapped.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

using fake::line_spec, fake::lines_of, fake::results_of;

TEST(Run, FolderHoldsWhatTheContractSays) {
  const fs::path folder = fake::test_folder() / "run";
  const RunResult result = start_run(fake::catalogue(), line_spec(3), folder, {});
  EXPECT_EQ(result.trials, 3);

  const auto trials = lines_of(folder / "trials.csv");
  ASSERT_EQ(trials.size(), 4u);
  EXPECT_EQ(trials[0],
            "trial,interaction_s,return,solved,predicted_return,rollouts,failed_rollouts,log_evidence,phi.gain,"
            "phi.gain.low,phi.gain.high");
  EXPECT_TRUE(trials[1].starts_with("1,1.2,")) << trials[1];
  EXPECT_NE(trials[1].find(",100,0,,1.2"), std::string::npos) << trials[1];  // no evidence before data
  EXPECT_TRUE(trials[1].ends_with(",,")) << trials[1] << ": nor is anything known of φ";
  EXPECT_TRUE(trials[2].ends_with(",0.1,4")) << trials[2];  // deviation 3: all of the box

  EXPECT_EQ(lines_of(folder / "timings.csv")[0], "trial,model_s,search_s,rollouts_per_s");
  const auto trajectory = lines_of(folder / "trajectories/trial-002.csv");
  EXPECT_EQ(trajectory[0], "time [s],x [m],true x [m],v [m/s],reward");
  EXPECT_EQ(trajectory.size(), 14u);
  EXPECT_TRUE(trajectory[1].starts_with("0,") && trajectory[1].ends_with(","));
  const auto prediction = lines_of(folder / "predictions/trial-002.csv");
  EXPECT_EQ(prediction[0], "time [s],particles,x mean [m],x 5% [m],x 25% [m],x 50% [m],x 75% [m],x 95% [m]");
  EXPECT_EQ(prediction.size(), 14u);
  const auto with_moments = lines_of(folder / "predictions/trial-003.csv");
  EXPECT_EQ(with_moments[0], prediction[0] +
                                 ",x std [m],x moment mean [m],x moment std [m],reward mean,reward std,"
                                 "reward moment mean,reward moment std");
  EXPECT_EQ(with_moments.size(), 14u);
  EXPECT_EQ(lines_of(folder / "errors.csv")[0], "trial,horizon,compared,failed,rms x [m]");
  EXPECT_EQ(lines_of(folder / "errors.csv").size(), 1u + 3 * 4);
  EXPECT_EQ(lines_of(folder / "notes.csv")[1], "1,\"a note, with a comma\"");
  EXPECT_EQ(lines_of(folder / "identifiability.csv"),
            (std::vector<std::string>{"trial,warning", "2,gain is not determined by these data: 0.1 to 4",
                                      "3,gain is not determined by these data: 0.1 to 4"}));
  EXPECT_EQ(result.warnings, std::vector<std::string>{"gain is not determined by these data: 0.1 to 4"});

  const auto memories = lines_of(folder / "memories.csv");  // the learner's own
  ASSERT_EQ(memories.size(), 3u);
  EXPECT_EQ(memories[0], "told,memory [m]");
  EXPECT_TRUE(memories[1].starts_with("3,")) << memories[1];
  EXPECT_EQ(memories[2], "0,");

  const auto policies = nlohmann::json::parse(files::read_file(folder / "policy.json"));
  EXPECT_EQ(policies["trials"].size(), 3u);
  EXPECT_EQ(policies["best"]["return"].get<double>(), result.best_return);
  EXPECT_EQ(policies["best"]["theta"].size(), 2u);
  EXPECT_TRUE(fs::exists(folder / "done"));
}

/// A cart whose brake does not engage after the last episode.
class Brakeless final : public system::Plant {
 public:
  explicit Brakeless(std::unique_ptr<system::Plant> cart) : cart_(std::move(cart)) {}
  Vector reset(Rng& rng) override { return cart_->reset(rng); }
  Vector step(const Vector& u) override { return cart_->step(u); }
  void require_finished() override {
    if (++finished_ == 2) throw system::Unavailable("the brake did not engage");
  }

 private:
  std::unique_ptr<system::Plant> cart_;
  int finished_ = 0;
};

TEST(Run, ARobotThatDidNotFinishItsLastEpisodeEndsTheRunAndTheTrialIsKept) {
  const auto brakeless = [](const fake::MakePlant& make) -> fake::MakePlant {
    return [make] { return std::make_unique<Brakeless>(make()); };
  };
  const fs::path folder = fake::test_folder() / "run";
  EXPECT_EQ(fake::message_of<RunFailed>([&] { start_run(fake::catalogue_with(brakeless), line_spec(2), folder, {}); }),
            "trial 2: the plant failed: the brake did not engage");
  EXPECT_EQ(lines_of(folder / "trials.csv").size(), 3u);
  EXPECT_EQ(lines_of(folder / "failed").at(0), "trial 2: the plant failed: the brake did not engage");
  EXPECT_EQ(resume_run(fake::catalogue(), folder, {}, {}).trials, 2);
  EXPECT_FALSE(fs::exists(folder / "failed"));
}

/// A learner all of whose rollouts fail.
class Lost final : public fake::Wrapped {
 public:
  using Wrapped::Wrapped;
  const learners::Proposal& ask() override {
    proposal_ = Wrapped::ask();
    proposal_.failed_rollouts = proposal_.rollouts;
    proposal_.failed_row = "in x = 1e+30";
    return proposal_;
  }

 private:
  learners::Proposal proposal_;
};

TEST(Run, APolicyThatWasNeverSimulatedMovesNoRobot) {
  const Catalogue lost = fake::catalogue_of([](auto inner) { return std::make_unique<Lost>(std::move(inner)); });
  const fs::path folder = fake::test_folder() / "run";
  EXPECT_EQ(
      fake::message_of<RunFailed>([&] { start_run(lost, line_spec(2), folder, {}); }),
      "trial 1: every rollout failed, 100 of them: the prior fails in x = 1e+30. No policy was simulated that could "
      "move the robot");
  EXPECT_EQ(lines_of(folder / "trials.csv").size(), 1u);
}

/// A learner that keeps the episodes it is told.
class Listener final : public fake::Wrapped {
 public:
  Listener(std::unique_ptr<learners::Learner> inner, std::vector<Episode>* told)
      : Wrapped(std::move(inner)), told_(told) {}
  void tell(const Episode& episode) override {
    told_->push_back(episode);
    Wrapped::tell(episode);
  }
  void load(const std::vector<Episode>& episodes, const nlohmann::json& state) override {
    *told_ = episodes;
    Wrapped::load(episodes, state);
  }

 private:
  std::vector<Episode>* told_;
};

Catalogue with_listener(std::vector<Episode>& told) {
  return fake::catalogue_of([&told](auto inner) { return std::make_unique<Listener>(std::move(inner), &told); });
}

// The same holds for the episodes loaded when a run is resumed; the folder has the noise-free states in any case.
TEST(Run, LearnersAreToldByNoiseFreeOrByMeasuredStates) {
  const fs::path folder = fake::test_folder();
  Spec spec = line_spec(3);
  spec.options = {{"noise", "0.05"}};
  std::vector<Episode> by_truth, by_measured;
  start_run(with_listener(by_truth), spec, folder / "truth", {});
  spec.options.emplace_back("told_by", "measured");
  spec.trials = 2;
  start_run(with_listener(by_measured), spec, folder / "measured", {});
  resume_run(with_listener(by_measured), folder / "measured", 3, {});
  ASSERT_EQ(by_truth.size(), 3u);
  ASSERT_EQ(by_measured.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(by_measured[i].states, by_truth[i].states);
    EXPECT_EQ(by_measured[i].true_states, by_truth[i].states);
    EXPECT_NE(by_truth[i].true_states, by_truth[i].states);
    const Vector x = by_truth[i].states.bottomRows(12).col(0);
    EXPECT_TRUE(by_measured[i].rewards.isApprox((-x.array().square()).exp().matrix()));
    EXPECT_NE(by_measured[i].rewards, by_truth[i].rewards);
  }
  for (const char* file : {"trials.csv", "trajectories/trial-003.csv"})
    EXPECT_EQ(files::read_file(folder / "measured" / file), files::read_file(folder / "truth" / file)) << file;
}

TEST(Run, FewerTrialsAreAPrefixOfMore) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(5), folder / "five", {});
  start_run(fake::catalogue(), line_spec(10), folder / "ten", {});
  EXPECT_TRUE(files::read_file(folder / "ten/trials.csv").starts_with(files::read_file(folder / "five/trials.csv")));
}

TEST(Run, SpecOfAFolderGivesTheSameRun) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(4), folder / "first", {});
  start_run(fake::catalogue(), from_toml(files::read_file(folder / "first/spec.toml"), ""), folder / "second", {});
  EXPECT_EQ(results_of(folder / "first"), results_of(folder / "second"));
}

TEST(Run, WrongInputLeavesNoFolder) {
  const fs::path folder = fake::test_folder();
  EXPECT_THROW(start_run(fake::catalogue(), line_spec(-1), folder / "a/b", {}), InvalidInput);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Run, ARefusedResumeChangesNothing) {
  const fs::path folder = fake::test_folder() / "run";
  const Catalogue without_plant = fake::catalogue_with([](const fake::MakePlant&) { return fake::MakePlant(); });
  start_run(without_plant, line_spec(0), folder, {});
  const std::string spec = files::read_file(folder / "spec.toml");
  EXPECT_THROW(resume_run(without_plant, folder, 5, {}), InvalidInput);
  EXPECT_EQ(files::read_file(folder / "spec.toml"), spec);
}

TEST(Run, UntilSolvedEndsWithTheFirstTrialThatSolves) {
  const fs::path folder = fake::test_folder();
  Spec spec = line_spec(6);
  const auto solved_at = start_run(fake::catalogue(), spec, folder / "whole", {}).solved_at;
  ASSERT_TRUE(solved_at);
  ASSERT_LT(*solved_at, 6);
  spec.until_solved = true;
  EXPECT_EQ(start_run(fake::catalogue(), spec, folder / "short", {}).trials, *solved_at);
  EXPECT_EQ(files::read_file(folder / "short/done"), std::to_string(*solved_at) + " trials\n");
  EXPECT_EQ(resume_run(fake::catalogue(), folder / "short", {}, {}).trials, *solved_at);
  EXPECT_EQ(resume_run(fake::catalogue(), folder / "short", Until(6, true), {}).trials, *solved_at);
  EXPECT_EQ(resume_run(fake::catalogue(), folder / "short", 6, {}).trials, 6);
  EXPECT_EQ(results_of(folder / "short"), results_of(folder / "whole"));
}

class Counter final : public RunListener {
 public:
  Index before = -1, progressed = 0, last = 0;
  void started(const Resolved&, const fs::path&, Index done) override { before = done; }
  void progress(Index, const Progress&) override { ++progressed; }
  void trial_done(const TrialRecord& record) override { last = record.trial; }
};

// Before what takes long after a trial, so that a stop there says how many there are.
TEST(Run, TellsItsListenerOfATrialThatIsKept) {
  const fs::path folder = fake::test_folder() / "run";
  Counter listener;
  const RunOptions options{.listener = &listener, .stop = [&] { return listener.last == 1; }};
  EXPECT_THROW(start_run(fake::catalogue(), line_spec(2), folder, options), Interrupted);
  EXPECT_EQ(listener.last, 1);
  EXPECT_EQ(RunFolder::read(folder).history.done(), 1);
}

TEST(Run, TellsItsListener) {
  const fs::path folder = fake::test_folder() / "run";
  Counter first, second;
  start_run(fake::catalogue(), line_spec(2), folder, {.listener = &first});
  EXPECT_EQ(first.before, 0);
  EXPECT_EQ(first.progressed, 2);
  EXPECT_EQ(first.last, 2);
  resume_run(fake::catalogue(), folder, 3, {.listener = &second});
  EXPECT_EQ(second.before, 2);
  EXPECT_EQ(second.last, 3);
}

}  // namespace
}  // namespace rehearse::experiment
