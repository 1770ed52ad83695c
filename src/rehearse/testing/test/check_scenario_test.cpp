#include "rehearse/testing/check_scenario.hpp"

#include <gtest/gtest.h>

#include "rehearse/robots/pendubot/pendubot.hpp"

namespace rehearse::testing {
namespace {

using Lines = std::vector<std::string>;

TEST(CheckScenario, AcceptsThePendubot) { EXPECT_EQ(check_scenario(robots::pendubot::make({})), Lines{}); }

TEST(CheckScenario, NamesThePartThatBreaksALaw) {
  auto scenario = robots::pendubot::make({});
  const auto remembers = [calls = std::make_shared<int>()](const ConstMatrixView& X, const ConstMatrixView&,
                                                           const Vector&, MatrixView dX) { dX = X * ++*calls; };
  scenario.priors[1].simulator = system::make_simulator(scenario.oracle->parameters(), remembers);
  const Lines lines = check_scenario(scenario);
  ASSERT_FALSE(lines.empty());
  for (const std::string& line : lines) EXPECT_TRUE(line.starts_with("prior tunable: ")) << line;

  scenario = robots::pendubot::make({});
  scenario.drawing->bodies.pop_back();
  EXPECT_EQ(check_scenario(scenario), Lines{"drawing: 2 lines for 1 bodies"});

  scenario = robots::pendubot::make({});
  scenario.task.saturating_reward->distances *= 1.001;
  ASSERT_EQ(check_scenario(scenario).size(), 1u);
  EXPECT_TRUE(check_scenario(scenario).front().starts_with("saturating_reward: "));

  scenario.task.actions.front().bounds = {-1, 1};  // the policy's are wider
  ASSERT_FALSE(check_scenario(scenario).empty());
  EXPECT_TRUE(check_scenario(scenario).front().starts_with("policy: "));

  scenario.task.reward = {};
  EXPECT_EQ(check_scenario(scenario), Lines{"task has no reward"});
}

TEST(RandomEpisodes, AreWholeAndDifferent) {
  const Dataset data = random_episodes(robots::pendubot::make({}), 2);
  ASSERT_EQ(data.size(), 100);
  EXPECT_EQ(data.states.row(0), data.states.row(50));
  EXPECT_NE(data.states.row(1), data.states.row(51));
}

}  // namespace
}  // namespace rehearse::testing
