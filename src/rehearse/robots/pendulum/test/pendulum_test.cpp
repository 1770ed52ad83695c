#include "rehearse/robots/pendulum/pendulum.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"
#include "rehearse/scenario/test/drawn_reward.hpp"
#include "rehearse/testing/check_scenario.hpp"

namespace rehearse::robots::pendulum {
namespace {

TEST(Pendulum, DerivativeIsThePublishedEquation) {
  Rng rng({.purpose = Purpose::test});
  for (int i = 0; i < 100; ++i) {
    const double w = rng.uniform(-9, 9), theta = rng.uniform(-9, 9), u = rng.uniform(-2.5, 2.5);
    const Vector x{{w, theta}}, phi{{rng.uniform(0.1, 2), rng.uniform(0.1, 2), rng.uniform(0, 1)}};
    Vector ours(2);
    kernel().derivative(x.data(), &u, phi.data(), ours.data());
    const double m = phi(0), l = phi(1), b = phi(2);
    const double slope = (u - b * w - m * 9.82 * l * std::sin(theta) / 2) / (m * l * l / 3);
    EXPECT_NEAR(ours(0), slope, 1e-12 * (1 + std::abs(slope)));
    EXPECT_EQ(ours(1), w);
  }
}

TEST(Pendulum, SimulatorIsWithin2e6OfTheAdaptiveIntegratorEverywhere) {
  const scenario::Scenario s = make({});
  const Dataset data = testing::random_episodes(s, 100);
  EXPECT_GT(data.states.col(0).cwiseAbs().maxCoeff(), 5) << "the episodes must visit fast motions";
  Matrix dX(data.size(), 2);
  s.oracle->change(data.states, data.actions, s.oracle->parameters().values(), dX);
  const double worst = (dX - data.changes).cwiseAbs().maxCoeff();
  RecordProperty("worst_error", std::to_string(worst));
  EXPECT_LT(worst, 2e-6);
}

TEST(Pendulum, MayHaveALimitOfItsSpeed) {
  EXPECT_TRUE(make({}).task.limits.empty());
  const Task task = make({.speed_limit = 6}).task;
  ASSERT_EQ(task.limits.size(), 1u);
  EXPECT_EQ(task.limits[0].text, "abs(dtheta) < 6 rad/s");
  EXPECT_TRUE(task.violations().empty());
}

TEST(Pendulum, KeepsTheLaws) {
  Options noisy, rbf, linear;
  noisy.ode.start_noise = 0.1, noisy.ode.measurement_noise = 0.01;
  rbf.ode.policy.policy = scenario::PolicyOptions::Kind::rbf;
  linear.ode.policy.policy = scenario::PolicyOptions::Kind::linear;
  for (const Options& options : {Options{}, noisy, rbf, linear})
    EXPECT_EQ(testing::check_scenario(make(options)), std::vector<std::string>{});
}

TEST(Pendulum, PriorsAreWrongInWhatTheyMayTuneExceptThePartialOne) {
  const scenario::Scenario s = make({});
  const Vector truth = s.oracle->parameters().values();
  EXPECT_EQ(truth, (Vector{{1, 1, 0.01}}));
  ASSERT_EQ(s.priors.size(), 4u);
  for (const auto& prior : s.priors) {
    EXPECT_EQ(prior.parameters.of_kind(Parameter::Kind::continuous), (std::vector<Index>{0, 1}));
    EXPECT_NE(prior.parameters.values(), truth);
    EXPECT_EQ(prior.parameters.values()(2) == truth(2), prior.name != "partial");
  }
}

TEST(Pendulum, CannotBeLiftedInOneGo) {
  const scenario::Scenario s = make({});
  const auto plant = s.make_plant();
  Rng rng({});
  plant->reset(rng);
  double highest = 0;
  for (Index t = 0; t < s.task.horizon; ++t) highest = std::max(highest, std::abs(plant->step(Vector{{2.5}})(1)));
  EXPECT_LT(highest, 2);
}

TEST(Pendulum, RewardAndSolutionAreUpright) {
  const scenario::Scenario s = make({});
  const Matrix X{{0, M_PI}, {0, 0}, {3, 2}}, U = Matrix::Zero(3, 1);
  Vector rewards(3);
  s.task.reward(X, U, X, rewards);
  EXPECT_NEAR(rewards(0), 1, 1e-15);
  EXPECT_NEAR(rewards(1), std::exp(-4 / 0.5), 1e-15);
  EXPECT_NEAR(rewards(2), std::exp(-(2 + 2 * std::cos(2.0)) / 0.5), 1e-15);

  Episode episode{.true_states = Matrix::Zero(41, 2), .actions = Matrix::Zero(40, 1)};
  episode.true_states.bottomRows(6).col(1) = Vector{{M_PI, -M_PI, 3 * M_PI, M_PI + 0.17, M_PI - 0.17, M_PI}};
  EXPECT_TRUE(s.task.solved(episode));
  episode.true_states(35, 1) = M_PI - 0.18;
  EXPECT_FALSE(s.task.solved(episode));
}

TEST(Pendulum, IsDrawnWithItsEndWhereTheRewardSeesIt) {
  scenario::expect_drawn_where_rewarded(make({}), Vector{{0, M_PI}}, 0.5);
}

}  // namespace
}  // namespace rehearse::robots::pendulum
