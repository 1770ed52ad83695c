#include "rehearse/moments/requirements.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "fixture.hpp"
#include "rehearse/moments/moment_kernel.hpp"
#include "rehearse/robots/cartpole/cartpole.hpp"

namespace rehearse::moments {
namespace {

std::vector<std::string> complaints(const Task& task, const policy::Policy& policy) {
  return without_moments(task, policy, {.who = "PILCO", .otherwise = "black-drops"});
}

TEST(Requirements, SayEverythingThatHasNoMoments) {
  Task task = robots::cartpole::make({}).task;
  EXPECT_TRUE(complaints(task, *fixture::rbf(task, 5)).empty());
  EXPECT_TRUE(complaints(task, *fixture::linear(task)).empty());
  const auto with_tanh = policy::make_linear({.features = task.feature_map(),
                                              .scale = Vector::Ones(task.feature_map().features()),
                                              .squash = {task.action_bounds(), 1}});
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView) {};
  task.cost = [](const Steps&, VectorView costs) { costs.setZero(); };
  task.episode_reward = [](const Episode&) { return 1; };
  task.limits.emplace_back();
  const auto all = complaints(task, *with_tanh);
  ASSERT_EQ(all.size(), 5u);
  EXPECT_TRUE(all[0].starts_with("policy = linear has no analytic moments, which PILCO needs")) << all[0];
  EXPECT_TRUE(all[1].starts_with("the task has a cost of steps")) << all[1];
  EXPECT_TRUE(all[2].starts_with("the task has a reward of whole episodes")) << all[2];
  EXPECT_EQ(all[3], "the task has limits, which PILCO does not keep: choose black-drops");
  EXPECT_NE(all[4].find("(in a robot's file [reward] distance = […] and width, or a formula exp(-(…)^2"),
            std::string::npos)
      << all[4];
  EXPECT_TRUE(all[4].ends_with("or choose black-drops")) << all[4];
}

TEST(Requirements, AModelOfTooManyInputsIsRefused) {
  Task task = robots::cartpole::make({}).task;
  const auto policy = fixture::rbf(task, 5);
  const Index more = kMostMomentInputs - task.feature_map().features() - task.action_size();
  for (Index i = 0; i < more; ++i) task.states.push_back({"more", "m"});
  EXPECT_TRUE(complaints(task, *policy).empty()) << "as many as there may be";
  task.states.push_back({"one more", "m"});
  ASSERT_EQ(complaints(task, *policy).size(), 1u);
  EXPECT_NE(complaints(task, *policy)[0].find("features and actions, PILCO takes at most"), std::string::npos);
}

TEST(Requirements, JointAnglesComeAfterTheFeaturesOfPolicies) {
  Task task = robots::cartpole::make({}).task;
  task.states = {{"v", "m/s"}, {"a", "rad", StateKind::angle}, {"b", "rad", StateKind::angle, "", "a"}};
  EXPECT_EQ(model_features(task, false).features(), 5);
  EXPECT_EQ(model_features(task, true).features(), 7);
  const Vector joint = Vector{{0, 0.4, -0.9}};
  Matrix features(1, 7);
  model_features(task, true).apply(joint.transpose(), features);
  EXPECT_NEAR(features(0, 5), std::cos(1.3), 1e-14);
  EXPECT_NEAR(std::abs(features(0, 6)), std::sin(1.3), 1e-14);
}

}  // namespace
}  // namespace rehearse::moments
