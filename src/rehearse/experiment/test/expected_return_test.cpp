#include "rehearse/experiment/expected_return.hpp"

#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/run_folder.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

using fake::column_of, fake::line_spec, fake::results_of;

TEST(ExpectedReturn, WithoutNoiseIsTheReturn) {
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
TEST(ExpectedReturn, IsAMeanOverManyEpisodes) {
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

TEST(ExpectedReturn, EvaluationsChangeNothingElse) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(4), folder / "without", {});
  Spec spec = line_spec(4);
  spec.options = {{"evaluations", "5"}};
  start_run(fake::catalogue(), spec, folder / "with", {});
  for (const std::string& name : files::read_csv(files::read_file(folder / "without/trials.csv")).header)
    EXPECT_EQ(column_of(folder / "with", name), column_of(folder / "without", name)) << name;
  for (const char* file : {"trajectories/trial-004.csv", "predictions/trial-004.csv", "errors.csv", "policy.json"})
    EXPECT_EQ(files::read_file(folder / "with" / file), files::read_file(folder / "without" / file)) << file;
}

TEST(ExpectedReturn, SurvivesAResume) {
  const fs::path folder = fake::test_folder();
  Spec spec = line_spec(2);
  spec.options = {{"evaluations", "5"}};
  start_run(fake::catalogue(), spec, folder / "resumed", {});
  resume_run(fake::catalogue(), folder / "resumed", 4, {});
  spec.trials = 4;
  start_run(fake::catalogue(), spec, folder / "whole", {});
  EXPECT_EQ(files::read_file(folder / "resumed/trials.csv"), files::read_file(folder / "whole/trials.csv"));
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

TEST(ExpectedReturn, AFailingEvaluationLosesNoEpisode) {
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

}  // namespace
}  // namespace rehearse::experiment
