#include "rehearse/testing/check_scenario.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/reward/saturating.hpp"
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
  std::get<scenario::LineDrawing>(*scenario.drawing).bodies.pop_back();
  EXPECT_EQ(check_scenario(scenario), Lines{"drawing: 2 lines for 1 bodies"});

  scenario = robots::pendubot::make({});
  scenario.task.descriptor_bounds.pop_back();
  scenario.task.descriptor_names.clear();
  EXPECT_EQ(check_scenario(scenario), Lines{"descriptor: 6 numbers, but 5 descriptor_bounds"});

  scenario = robots::pendubot::make({});
  reward::ClosedForm wrong = *reward::closed_form(scenario.task.reward);
  wrong.distances *= 1.001;
  scenario.task.reward = reward::saturating(
      [reward = scenario.task.reward](const ConstMatrixView& X, VectorView d2) {
        reward(X, Matrix::Zero(X.rows(), 1), X, d2);
        d2 = -2 * d2.array().log();
      },
      1, wrong);
  ASSERT_EQ(check_scenario(scenario).size(), 1u);
  EXPECT_TRUE(check_scenario(scenario).front().starts_with("closed form of the reward: "));

  scenario.task.actions.front().bounds = {-1, 1};  // the policy's are wider
  ASSERT_FALSE(check_scenario(scenario).empty());
  EXPECT_TRUE(check_scenario(scenario).front().starts_with("policy: "));

  scenario.task.reward = {};
  EXPECT_EQ(check_scenario(scenario), Lines{"task has no reward"});
}

TEST(CheckScenario, NamesAPoseThatIsNone) {
  auto scenario = robots::pendubot::make({});
  scenario::Pose pose;
  const auto drawing = [&pose](std::size_t bodies) {
    return scenario::SolidDrawing{
        .bodies = std::vector(bodies, scenario::SolidDrawing::Body{"foot", scenario::Sphere{1}}),
        .poses = [pose](const ConstVectorView&) { return std::vector{pose}; }};
  };
  scenario.drawing = drawing(1);
  EXPECT_EQ(check_scenario(scenario), Lines{});
  scenario.drawing = drawing(2);
  EXPECT_EQ(check_scenario(scenario), Lines{"drawing: 1 poses for 2 bodies"});
  pose.orientation.w() = 2;
  scenario.drawing = drawing(1);
  EXPECT_EQ(check_scenario(scenario), Lines{"drawing: a quaternion of norm 2 in state 0"});
  pose.position.z() = std::nan("");
  scenario.drawing = drawing(1);
  EXPECT_EQ(check_scenario(scenario), Lines{"drawing: not finite in state 0"});
}

TEST(RandomEpisodes, AreWholeAndDifferent) {
  const Dataset data = random_episodes(robots::pendubot::make({}), 2);
  ASSERT_EQ(data.size(), 100);
  EXPECT_EQ(data.states.row(0), data.states.row(50));
  EXPECT_NE(data.states.row(1), data.states.row(51));
}

}  // namespace
}  // namespace rehearse::testing
