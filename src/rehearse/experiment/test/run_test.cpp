#include "rehearse/experiment/run.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fake.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/run_folder.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "rehearse/files/write.hpp"
#include "rehearse/statistics/table.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

Spec line_spec(Index trials, const std::string& learner = "echo") {
  return {.scenario = "line", .learner = learner, .trials = trials, .seed = 3};
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::istringstream text(files::read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Bytes of everything in a run folder that must not depend on how the run came about.
std::string results_of(const fs::path& folder) {
  std::string bytes;
  for (const std::string name : {"spec.toml", "trials.csv", "errors.csv", "identifiability.csv", "notes.csv",
                                 "memories.csv", "policy.json", "done"})
    bytes += name + "\n" + files::read_file(folder / name);
  for (const std::string name : {"trajectories/trial-001.csv", "predictions/trial-003.csv"})
    bytes += name + "\n" + files::read_file(folder / name);
  return bytes;
}

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
            (std::vector<std::string>{"trial,warning", "2,gain is not determined by these trials: 0.1 to 4",
                                      "3,gain is not determined by these trials: 0.1 to 4"}));
  EXPECT_EQ(result.warnings, std::vector<std::string>{"gain is not determined by these trials: 0.1 to 4"});

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

TEST(Run, LearnerWithoutPriorHasNoModelColumns) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(2, "echo-alone"), folder, {});
  const auto trials = lines_of(folder / "trials.csv");
  EXPECT_EQ(trials[0], "trial,interaction_s,return,solved,predicted_return,rollouts,failed_rollouts,log_evidence");
  EXPECT_TRUE(trials[1].ends_with(",,100,0,")) << trials[1];
  EXPECT_TRUE(fs::is_empty(folder / "predictions"));
}

/// The cells of a column of a run's trials.csv.
std::vector<std::string> column_of(const fs::path& folder, const std::string& name) {
  const statistics::Table table = statistics::read_csv(files::read_file(folder / "trials.csv"));
  const auto place = static_cast<std::size_t>(table.column(name));
  std::vector<std::string> cells;
  for (const auto& row : table.rows) cells.push_back(row.at(place));
  return cells;
}

TEST(Run, ExpectedReturnWithoutNoiseIsTheReturn) {
  const fs::path folder = fake::test_folder() / "run";
  Spec spec = line_spec(3);
  spec.options = {{"noise", "0"}, {"evaluations", "7"}};
  start_run(fake::catalogue(), spec, folder, {});
  EXPECT_EQ(column_of(folder, "expected_return"), column_of(folder, "return"));
  spec.learner = "echo-alone";
  const fs::path scheduled = fake::test_folder() / "scheduled";
  start_run(fake::catalogue(), spec, scheduled, {});
  EXPECT_EQ(column_of(scheduled, "expected_return"), column_of(scheduled, "return"))
      << "each trial with the policy that it had";
}

// Seed 3. The start is N(1, 0.1²): returns differ, their means hardly.
TEST(Run, ExpectedReturnIsAMeanOverManyEpisodes) {
  const fs::path folder = fake::test_folder();
  std::vector<double> means;
  for (const char* evaluations : {"1", "2", "400", "800"}) {
    Spec spec = line_spec(1);
    spec.options = {{"evaluations", evaluations}};
    start_run(fake::catalogue(), spec, folder / evaluations, {});
    means.push_back(std::stod(column_of(folder / evaluations, "expected_return").front()));
  }
  EXPECT_NE(means[0], std::stod(column_of(folder / "1", "return").front())) << "its streams are its own";
  EXPECT_NE(means[0], means[1]);
  EXPECT_NEAR(means[2], means[3], 0.1);
}

TEST(Run, EvaluationsChangeNothingElse) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(4), folder / "without", {});
  Spec spec = line_spec(4);
  spec.options = {{"evaluations", "5"}};
  start_run(fake::catalogue(), spec, folder / "with", {});
  for (const std::string& name : statistics::read_csv(files::read_file(folder / "without/trials.csv")).header)
    EXPECT_EQ(column_of(folder / "with", name), column_of(folder / "without", name)) << name;
  for (const char* file : {"trajectories/trial-004.csv", "predictions/trial-004.csv", "errors.csv", "policy.json"})
    EXPECT_EQ(files::read_file(folder / "with" / file), files::read_file(folder / "without" / file)) << file;
}

TEST(Run, ExpectedReturnsSurviveAResume) {
  const fs::path folder = fake::test_folder();
  Spec spec = line_spec(2);
  spec.options = {{"evaluations", "5"}};
  start_run(fake::catalogue(), spec, folder / "resumed", {});
  resume_run(fake::catalogue(), folder / "resumed", 4, {});
  spec.trials = 4;
  start_run(fake::catalogue(), spec, folder / "whole", {});
  EXPECT_EQ(files::read_file(folder / "resumed/trials.csv"), files::read_file(folder / "whole/trials.csv"));
}

/// A learner that keeps what it is told.
class Listener final : public learners::Learner {
 public:
  Listener(std::unique_ptr<learners::Learner> echo, std::vector<Episode>* told) : echo_(std::move(echo)), told_(told) {}
  const learners::Proposal& ask() override { return echo_->ask(); }
  void tell(const Episode& episode) override {
    told_->push_back(episode);
    echo_->tell(episode);
  }
  nlohmann::json save() const override { return echo_->save(); }
  std::vector<learners::Table> tables() const override { return echo_->tables(); }
  void load(const std::vector<Episode>& episodes, const nlohmann::json& state) override {
    *told_ = episodes;
    echo_->load(episodes, state);
  }

 private:
  std::unique_ptr<learners::Learner> echo_;
  std::vector<Episode>* told_;
};
Catalogue with_listener(std::vector<Episode>& told) {
  class Builder final : public fake::EchoBuilder {
   public:
    explicit Builder(std::vector<Episode>* told) : EchoBuilder(true, {}), told_(told) {}
    std::unique_ptr<learners::Learner> build(learners::Setting setting) const override {
      return std::make_unique<Listener>(EchoBuilder::build(std::move(setting)), told_);
    }

   private:
    std::vector<Episode>* told_;
  };
  Catalogue catalogue = fake::catalogue();
  catalogue.learner_families = {[&told] {
    std::vector<std::unique_ptr<learners::LearnerBuilder>> family;
    family.push_back(std::make_unique<Builder>(&told));
    return family;
  }};
  return catalogue;
}

// Also what it loads when a run is resumed; the folder tells of the noise-free states in any case.
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

/// The line whose every plant but the first of a run, the robot, fails in its first step; the robot's episodes count.
Catalogue evaluations_fail(Index& robot_episodes) {
  class Plant final : public system::Plant {
   public:
    Plant(std::unique_ptr<system::Plant> line, Index* robot_episodes)
        : line_(std::move(line)), robot_episodes_(robot_episodes) {}
    Vector reset(Rng& rng) override {
      if (robot_episodes_) ++*robot_episodes_;
      return line_->reset(rng);
    }
    Vector step(const Vector& u) override {
      if (!robot_episodes_) throw std::runtime_error("no second robot");
      return line_->step(u);
    }
    Vector truth() const override { return line_->truth(); }

   private:
    std::unique_ptr<system::Plant> line_;
    Index* robot_episodes_;
  };
  return fake::catalogue_with([&robot_episodes](fake::MakePlant make) {
    return [&robot_episodes, make, first = true]() mutable {
      return std::make_unique<Plant>(make(), std::exchange(first, false) ? &robot_episodes : nullptr);
    };
  });
}

TEST(Run, AFailingEvaluationLosesNoEpisode) {
  const fs::path folder = fake::test_folder();
  Spec spec = line_spec(4);
  spec.options = {{"evaluations", "5"}};
  Index robot_episodes = 0;
  const auto message =
      fake::message_of<RunFailed>([&] { start_run(evaluations_fail(robot_episodes), spec, folder / "failed", {}); });
  EXPECT_EQ(message, "trial 1: the plant of the evaluations failed: no second robot");
  EXPECT_EQ(robot_episodes, 1);
  EXPECT_EQ(RunFolder::open(folder / "failed").load().episodes.size(), 1u);
  EXPECT_EQ(column_of(folder / "failed", "expected_return"), std::vector<std::string>{""});

  resume_run(fake::catalogue(), folder / "failed", {}, {});
  start_run(fake::catalogue(), spec, folder / "whole", {});
  EXPECT_EQ(results_of(folder / "failed"), results_of(folder / "whole"));
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

TEST(Run, AnExistingFolderIsNeverOverwritten) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(1), folder / "run", {});
  fs::create_directory(folder / "empty");
  std::ofstream(folder / "file") << "mine";
  for (const std::string name : {"run", "run/", "empty", "file"}) {
    const auto message =
        fake::message_of<InvalidInput>([&] { start_run(fake::catalogue(), line_spec(1), folder / name, {}); });
    EXPECT_NE(message.find("already exists"), std::string::npos) << name;
  }
  EXPECT_EQ(files::read_file(folder / "file"), "mine");
}

TEST(Run, WrongInputLeavesNoFolder) {
  const fs::path folder = fake::test_folder();
  EXPECT_THROW(start_run(fake::catalogue(), line_spec(0), folder / "a/b", {}), InvalidInput);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Resume, AfterAStopAnywhereGivesTheSameBytes) {
  const fs::path folder = fake::test_folder();
  Spec spec = line_spec(4);
  spec.options = {{"evaluations", "5"}};
  constexpr Index kSteps = 12, kPolls = 3 + kSteps + 5 * (1 + kSteps);  // of a trial: policy, episode, evaluations
  Index polls_of_all = 0;
  start_run(fake::catalogue(), spec, folder / "whole", {.stop = [&] { return ++polls_of_all == 0; }});
  EXPECT_EQ(polls_of_all, 4 * kPolls);
  const std::string expected = results_of(folder / "whole");
  bool stopped = true;
  for (Index stops = 0; stopped; stops += 7) {
    const fs::path run = folder / ("stopped-" + std::to_string(stops));
    Index polls = 0;
    stopped = false;
    try {
      start_run(fake::catalogue(), spec, run, {.stop = [&] { return polls++ == stops; }});
    } catch (const Interrupted&) {
      stopped = true;
      EXPECT_FALSE(fs::exists(run / "done"));
      EXPECT_EQ(RunFolder::open(run).load().done(), (stops + kPolls - 3 - kSteps) / kPolls) << stops;
      resume_run(fake::catalogue(), run, {}, {});
    }
    EXPECT_EQ(results_of(run), expected) << stops;
  }
}

TEST(Run, AnEpisodeThatFailsIsSaidInTheNotes) {
  const fs::path folder = fake::test_folder();
  Catalogue catalogue = fake::catalogue();
  catalogue.scenarios = {[] {
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
    return std::make_unique<Faulty>();
  }};
  start_run(catalogue, line_spec(2), folder / "run", {});
  const auto notes = lines_of(folder / "run/notes.csv");
  for (const std::string trial : {"1", "2"})
    EXPECT_EQ(std::count(notes.begin(), notes.end(),
                         trial + ",the episode ended at the reward floor: the reward at step 1 is not finite"),
              1);
  EXPECT_EQ(files::read_file(folder / "run/trials.csv").find("nan"), std::string::npos);
}

/// Runs in a process of its own that kills itself; true if it did.
bool run_killed(const fs::path& folder, fake::Killer killer) {
  const pid_t child = ::fork();
  if (child == 0) {
    start_run(fake::catalogue(killer), line_spec(4), folder, {});
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

TEST(Resume, AfterAKillGivesTheSameBytes) {
  using Place = fake::Killer::Place;
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(4), folder / "whole", {});
  const std::string expected = results_of(folder / "whole");
  for (Place place : {Place::ask, Place::tell, Place::save})
    for (Index call = 0; call < 4; ++call) {
      const fs::path run = folder / ("killed-" + std::to_string(static_cast<int>(place)) + std::to_string(call));
      if (!run_killed(run, {place, call})) {
        EXPECT_TRUE(place == Place::save && call == 0);  // nothing to save before the first trial
        continue;
      }
      resume_run(fake::catalogue(), run, {}, {});
      EXPECT_EQ(results_of(run), expected) << static_cast<int>(place) << " " << call;
    }
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

TEST(Resume, ExtendsARunAndNeverShrinksIt) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(6), folder / "six", {});
  start_run(fake::catalogue(), line_spec(2), folder / "two", {});
  EXPECT_EQ(resume_run(fake::catalogue(), folder / "two", {}, {}).trials, 2);
  EXPECT_EQ(resume_run(fake::catalogue(), folder / "two", 6, {}).trials, 6);
  EXPECT_EQ(results_of(folder / "six"), results_of(folder / "two"));
  const auto message = fake::message_of<InvalidInput>([&] { resume_run(fake::catalogue(), folder / "two", 5, {}); });
  EXPECT_NE(message.find("trials = 5, but 6 trials of"), std::string::npos) << message;
}

TEST(Resume, RefusesWhatIsNoRunFolder) {
  const fs::path folder = fake::test_folder();
  const auto complaint = [&](const std::string& name) {
    return fake::message_of<InvalidInput>([&] { resume_run(fake::catalogue(), folder / name, {}, {}); });
  };
  EXPECT_NE(complaint("nothing").find("nothing is not a folder"), std::string::npos);
  fs::create_directory(folder / "empty");
  EXPECT_NE(complaint("empty").find("is not a run folder: it has no spec.toml"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(folder / "empty"));

  start_run(fake::catalogue(), line_spec(2), folder / "run", {});
  const std::string spec = files::read_file(folder / "run/spec.toml"),
                    checkpoint = files::read_file(folder / "run/checkpoint");
  files::write_file(folder / "run/checkpoint", checkpoint.substr(0, checkpoint.size() / 2));
  EXPECT_NE(complaint("run").find("the checkpoint is truncated or damaged"), std::string::npos);
  files::write_file(folder / "run/checkpoint", checkpoint);
  files::write_file(folder / "run/spec.toml", spec.substr(0, spec.size() / 2) + "= =");
  EXPECT_NE(complaint("run").find("spec.toml: line "), std::string::npos);
  files::write_file(folder / "run/spec.toml", spec + "# harmless\n");
  EXPECT_EQ(complaint("run"), "");
  files::write_file(folder / "run/spec.toml", std::string(spec).replace(spec.find("seed = 3"), 8, "seed = 4"));
  EXPECT_NE(complaint("run").find("belongs to another spec.toml"), std::string::npos);
}

TEST(Resume, OneProcessAtATime) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(1), folder, {});
  const files::FolderLock lock(folder);
  EXPECT_NE(fake::message_of<InvalidInput>([&] { resume_run(fake::catalogue(), folder, 2, {}); }).find("in use"),
            std::string::npos);
}

/// Of what fails when the run in a folder is resumed.
bool may_resuming_help(const fs::path& folder) {
  try {
    resume_run(fake::catalogue(), folder, 9, {});
  } catch (const RunFailed& error) {
    return error.resume_may_help();
  }
  ADD_FAILURE() << "nothing failed";
  return false;
}

TEST(Resume, MayHelpWhereAFileCouldNotBeWritten) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(8), folder, {});
  fs::create_directory(folder / "trials.csv.tmp");  // which a file cannot replace
  EXPECT_TRUE(may_resuming_help(folder));
  fs::remove(folder / "trials.csv.tmp");
  EXPECT_EQ(resume_run(fake::catalogue(), folder, 9, {}).trials, 9);
}

TEST(Run, AFailingPlantKeepsWhatWasDone) {
  const fs::path folder = fake::test_folder() / "run";
  Spec spec = line_spec(8);
  spec.options = {{"breaks", "true"}};
  const auto message = fake::message_of<RunFailed>([&] { start_run(fake::catalogue(), spec, folder, {}); });
  EXPECT_NE(message.find("the plant failed: the wheel came off"), std::string::npos) << message;
  const auto kept = lines_of(folder / "trials.csv").size();
  EXPECT_LT(kept, 9u);
  EXPECT_EQ(fake::message_of<RunFailed>([&] { resume_run(fake::catalogue(), folder, {}, {}); }), message);
  EXPECT_FALSE(may_resuming_help(folder)) << "it fails in the same way";
  EXPECT_EQ(lines_of(folder / "trials.csv").size(), kept);
}

class Counter final : public RunListener {
 public:
  Index before = -1, progressed = 0, last = 0;
  void started(const Resolved&, const fs::path&, Index done) override { before = done; }
  void progress(Index, const Progress&) override { ++progressed; }
  void trial_done(const TrialRecord& record) override { last = record.trial; }
};

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
