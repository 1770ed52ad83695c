#include "rehearse/learners/black_drops/moments.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/rbf.hpp"
#include "rehearse/testing/check_learner.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

using slider::learn, slider::run_trial;

/// The slider with a policy and a reward whose moments are known.
Setting setting() {
  Setting setting = slider::setting({});
  setting.task.saturating_reward = SaturatingReward{Vector::Zero(1), Matrix::Constant(1, 1, 1 / 0.2)};
  setting.policy = policy::make_rbf(
      {.features = setting.task.feature_map(), .scale = Vector::Constant(1, 2), .centres = 2, .bounds = {{-1, 1}}});
  return setting;
}

std::unique_ptr<LearnerBuilder> by_moments(const std::string& name = "black-drops") {
  auto builder = slider::builder(name);
  EXPECT_TRUE(set_field([&](FieldVisitor& v) { builder->fields(v); }, "search.evaluation", "moments"));
  return builder;
}

TEST(Moments, ASearchByMomentsKeepsTheLaws) {
  EXPECT_EQ(testing::check_learner(*by_moments(), setting(), run_trial), std::vector<std::string>{});
}

// A policy that does nothing earns about 0, one that stops at 0 at once about 9.
TEST(Moments, ASearchByMomentsLearnsTheSliderAndKnowsItsReturn) {
  const auto [proposals, returns] = learn(*by_moments()->build(setting()), 4);
  EXPECT_GT(returns.back(), 7);
  const Proposal& last = proposals.back();
  ASSERT_TRUE(last.predicted_return && last.moments);
  EXPECT_NEAR(*last.predicted_return, last.moments().rewards.sum(), 1e-9);
  EXPECT_NEAR(*last.predicted_return, returns.back(), 1);
}

TEST(Moments, AProposalHasThemWhereAllPartsDo) {
  const auto second = [](const std::string& name, const Setting& setting) {
    return learn(*slider::builder(name)->build(setting), 2).proposals.back();
  };
  const Proposal proposal = second("black-drops", setting());
  ASSERT_TRUE(proposal.moments);
  EXPECT_NEAR(proposal.moments().rewards.sum(), *proposal.predicted_return, 1);  // of 10 rollouts
  Setting linear = setting();
  linear.policy = slider::policy();
  EXPECT_FALSE(second("black-drops", linear).moments);
  Setting with_prior = setting();
  with_prior.prior = slider::prior();
  EXPECT_FALSE(second("black-drops-prior", with_prior).moments);
}

// The task names which link carries which; the GPs see the angle between them.
TEST(Moments, OfJointAnglesAreOfTheKernelsInputs) {
  Setting with = setting();
  with.task.states = {{"x", "m"}, {"a", "rad", StateKind::angle}, {"b", "rad", StateKind::angle, "", "a"}};
  Options options;
  identification::ZeroMean model;
  Dataset data{Matrix::Random(6, 3), Matrix::Random(6, 1), Matrix::Random(6, 3), Vector::Zero(6)};
  for (const bool joint_angles : {true, false}) {
    model.gp.joint_angles = joint_angles;
    options.model = model;
    const Index inputs = joint_angles ? 8 : 6;
    const std::vector<gp::Hyperparameters> kernels(3, {.log_lengths = Vector::Zero(inputs)});
    EXPECT_EQ(moments_of(options, with.task, data, kernels)->inputs(), inputs);
  }
}

/// What is said of a task whose rates and joints are named.
std::string refusal(const Options& options, const Task& task, const policy::Policy& policy) {
  std::string all;
  for (const std::string& line : without_moments(options, task, policy)) all += line + "\n";
  return all;
}

TEST(Moments, RefusesWhatHasNoneAndSaysWhatToUse) {
  Task task = setting().task;
  task.states = {{"a", "rad", StateKind::angle, "v"}, {"v", "rad/s"}, {"b", "rad", StateKind::angle, "", "a"}};
  task.actions.front().target_of = "v";
  task.saturating_reward.reset();
  Options options;
  identification::ZeroMean model;
  model.gp.fit.trend = model.gp.smooth = true;
  model.gp.variance = dynamics::PredictedVariance::noisy;
  options.model = model;
  options.reward.learned = true;
  const std::string all = refusal(options, task, *slider::policy());
  for (const char* part : {"model.gp.trend = false", "model.gp.smooth = false", "model.gp.integrate_rates = false",
                           "model.gp.variance = latent", "reward.learned = false", "the target of a state",
                           "policy = rbf", "saturating_reward", "search.evaluation = samples"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " in\n" << all;
  options.model = identification::GpMi{};
  EXPECT_NE(refusal(options, task, *slider::policy()).find("a model around a simulator"), std::string::npos);

  const Setting good = setting();
  EXPECT_EQ(by_moments()->violations(good.task, *good.policy), std::vector<std::string>{});
  EXPECT_EQ(by_moments("gp-mi")->violations(good.task, *good.policy).size(), 1U);
  EXPECT_EQ(slider::builder("gp-mi")->violations(task, *slider::policy()), std::vector<std::string>{});
  Setting with_prior = setting();
  with_prior.prior = slider::prior();
  EXPECT_THROW(by_moments("mi")->build(with_prior), InvalidInput);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
