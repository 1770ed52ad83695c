#include "rehearse/experiment/exported_policy.hpp"

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"

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

TEST(ExportedPolicy, OneThatSaysNothingOfItselfIsRefused) {
  const std::filesystem::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(1), folder, {});
  const PastRun run = read_run(fake::catalogue(), folder);
  EXPECT_EQ(message_of<InvalidInput>([&] { exported_policy(run); }),
            "a policy of kind 'line' does not say what it is made of");
}

}  // namespace
}  // namespace rehearse::experiment
