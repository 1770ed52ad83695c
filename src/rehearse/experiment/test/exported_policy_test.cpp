#include "rehearse/experiment/exported_policy.hpp"

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/policy/hand_over.hpp"
#include "rehearse/policy/schedule.hpp"

namespace rehearse::experiment {
namespace {

using fake::line_spec, fake::message_of;

TEST(ExportedPolicy, IsThatOfItsTrial) {
  const std::filesystem::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(2, "echo-alone"), folder, {});
  const PastRun run = read_run(fake::catalogue(), folder);
  const policy::Exported exported = exported_policy(run, 1);
  EXPECT_EQ(exported.kind, "schedule");
  EXPECT_EQ(exported.origin.robot, "line");
  EXPECT_EQ(exported.origin.learner, "echo-alone");
  EXPECT_EQ(exported.origin.total_reward, run.trial(1).total_reward);
  EXPECT_EQ(exported.theta, run.trial(1).theta);
  const Episode& episode = run.history.episodes[0];
  ASSERT_EQ(exported.answers.states.rows(), 13) << "the whole episode is short";
  EXPECT_EQ(exported.answers.states, episode.states);
  EXPECT_EQ(exported.answers.actions.topRows(12), episode.actions) << "as the robot was told";
}

TEST(ExportedPolicy, IsTestedNearItsGoal) {
  const std::filesystem::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(1, "echo-alone"), folder, {});
  PastRun run = read_run(fake::catalogue(), folder);
  const Task& task = run.resolved.scenario.task;
  run.resolved.scenario.policy = policy::make_schedule(task.action_bounds(), task.dt_s, task.horizon);
  const policy::HandOver far_away{{Vector{{0.3}}, Vector{{1e3}}, Matrix{{-2}}}, Matrix{{4}}};
  TrialRecord record = run.trial(1);
  record.policy = policy::kHandOver;
  record.theta = policy::to_theta(Vector::Zero(task.horizon), far_away);
  const policy::Exported exported = exported_policy(run.resolved, record, &run.history.episodes[0]);
  ASSERT_EQ(exported.answers.states.rows(), 14);
  EXPECT_TRUE(exported.answers.actions.topRows(13).isZero(0));
  EXPECT_DOUBLE_EQ(exported.answers.states(13, 0), 1e3 + 0.25);
  EXPECT_NEAR(exported.answers.actions(13, 0), 0.3 - 2 * 0.25, 1e-9);
}

TEST(ExportedPolicy, OneThatSaysNothingOfItselfIsRefused) {
  const std::filesystem::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(1), folder, {});
  const PastRun run = read_run(fake::catalogue(), folder);
  EXPECT_EQ(message_of<InvalidInput>([&] { exported_policy(run); }),
            "a policy of kind 'line' does not say what it is made of");
}

}  // namespace
}  // namespace rehearse::experiment
