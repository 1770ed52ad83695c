#include "rehearse/robots/cartpole/cartpole.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"
#include "rehearse/reward/saturating.hpp"
#include "rehearse/scenario/test/drawn_reward.hpp"
#include "rehearse/testing/check_scenario.hpp"

namespace rehearse::robots::cartpole {
namespace {

constexpr double kG = 9.82;

/// The equations once more, as they are printed, to check the vectorised ones.
Vector reference(const Vector& state, double u, const Vector& phi) {
  const double m = phi(0), M = phi(1), l = phi(2), b = phi(3), dx = state(1), w = state(2), angle = state(3);
  const double s = std::sin(angle), c = std::cos(angle);
  const double ddx = (2 * m * l * w * w * s + 3 * m * kG * s * c + 4 * u - 4 * b * dx) / (4 * (M + m) - 3 * m * c * c);
  const double dw = (-3 * m * l * w * w * s * c - 6 * (M + m) * kG * s - 6 * (u - b * dx) * c) /
                    (4 * l * (M + m) - 3 * m * l * c * c);
  return Vector{{dx, ddx, dw, w}};
}

TEST(Cartpole, DerivativeIsThePublishedEquation) {
  Rng rng({.purpose = Purpose::test});
  for (int i = 0; i < 100; ++i) {
    Vector x(4), phi(4), ours(4);
    for (double& value : x) value = rng.uniform(-8, 8);
    for (double& value : phi) value = rng.uniform(0.1, 1.2);
    const double u = rng.uniform(-10, 10);
    kernel().derivative(x.data(), &u, phi.data(), ours.data());
    const Vector theirs = reference(x, u, phi);
    EXPECT_LT((ours - theirs).norm(), 1e-12 * (1 + theirs.norm()));
  }
}

/// Error of a control step of the simulator, at every state that 25 random policies reach. (The adaptive
/// integrator takes long where the cart is far away.)
double worst_error(Options options) {
  options.ode.start_noise = options.ode.measurement_noise = 0;
  const scenario::Scenario s = make(options);
  const Dataset data = testing::random_episodes(s, 25);
  EXPECT_GT(data.states.col(2).cwiseAbs().maxCoeff(), 10) << "the episodes must visit fast motions";
  Matrix dX(data.size(), 4);
  s.oracle->change(data.states, data.actions, s.oracle->parameters().values(), dX);
  return (dX - data.changes).cwiseAbs().maxCoeff();
}

TEST(Cartpole, SimulatorIsWithin2e6OfTheAdaptiveIntegratorEverywhere) {
  const double worst = worst_error({});
  RecordProperty("worst_error", std::to_string(worst));
  EXPECT_LT(worst, 2e-6);
  EXPECT_LT(worst_error({.dt_s = 0.05, .horizon = 60}), 2e-6);
}

TEST(Cartpole, ATrackIsALimitOfThePosition) {
  EXPECT_TRUE(make({}).task.limits.empty());
  const Task task = make({.track = 0.6, .risk = 0.1}).task;
  ASSERT_EQ(task.limits.size(), 1u);
  EXPECT_EQ(task.limits[0].name, "track");
  EXPECT_EQ(task.limits[0].text, "abs(x) < 0.6 m");
  EXPECT_EQ(task.limits[0].risk, 0.1);
  EXPECT_TRUE(task.violations().empty());
}

TEST(Cartpole, KeepsTheLaws) {
  Options rbf;
  rbf.ode.policy.policy = scenario::PolicyOptions::Kind::rbf;
  for (const Options& options :
       {Options{}, Options{.dt_s = 0.05, .horizon = 60, .shaping = 0.5}, rbf, Options{.track = 0.6}})
    EXPECT_EQ(testing::check_scenario(make(options)), std::vector<std::string>{});
}

TEST(Cartpole, PriorsAreWrongInWhatTheyMayTuneExceptThePartialOne) {
  const scenario::Scenario s = make({});
  const Vector truth = s.oracle->parameters().values();
  EXPECT_EQ(truth, (Vector{{0.5, 0.5, 0.5, 0.1}}));
  ASSERT_EQ(s.priors.size(), 4u);
  for (const auto& prior : s.priors) {
    EXPECT_EQ(prior.parameters.of_kind(Parameter::Kind::continuous), (std::vector<Index>{0, 1, 2}));
    EXPECT_NE(prior.parameters.values(), truth);
    EXPECT_EQ(prior.parameters.values()(3) == truth(3), prior.name != "partial");
  }
  EXPECT_EQ(s.policy->parameters(), 71);
}

double reward(const scenario::Scenario& s, double x, double theta) {
  const Matrix X{{x, 0, 0, theta}}, U{{0}};
  Vector rewards(1);
  s.task.reward(X, U, X, rewards);
  return rewards(0);
}

TEST(Cartpole, RewardIsTheTipsDistance) {
  const scenario::Scenario s = make({});
  EXPECT_NEAR(reward(s, 0, M_PI), 1, 1e-15);
  EXPECT_NEAR(reward(s, 0, -M_PI), 1, 1e-15);
  EXPECT_NEAR(reward(s, 0, 0), std::exp(-1 / 0.125), 1e-15);
  EXPECT_NEAR(reward(s, 0.3, M_PI), std::exp(-0.09 / 0.125), 1e-15);
  const double x = 0.2, theta = 2.5, tip_x = x + 0.5 * std::sin(theta), tip_y = -0.5 * std::cos(theta);
  EXPECT_NEAR(reward(s, x, theta), std::exp(-(tip_x * tip_x + (tip_y - 0.5) * (tip_y - 0.5)) / 0.125), 1e-15);
}

TEST(Cartpole, ShapingMixesAWideRewardOfAngleAndPlace) {
  const auto shaped = [](double share) { return make({.shaping = share}); };
  EXPECT_EQ(reward(shaped(0.5), 0, M_PI), 1);
  EXPECT_NEAR(reward(shaped(1), 0, 0), std::exp(-M_PI * M_PI / 9), 1e-15);
  EXPECT_NEAR(reward(shaped(1), 0.5, -M_PI + 0.6), std::exp(-0.04 - 0.25), 1e-15);
  EXPECT_NEAR(reward(shaped(1), 0, 3 * M_PI + 0.6), std::exp(-0.04), 1e-15) << "full turns count nothing";
  EXPECT_NEAR(reward(shaped(0.3), 0.4, 2), 0.7 * reward(make({}), 0.4, 2) + 0.3 * reward(shaped(1), 0.4, 2), 1e-15);
  EXPECT_TRUE(reward::closed_form(make({}).task.reward));
  EXPECT_FALSE(reward::closed_form(shaped(0.5).task.reward));
}

TEST(Cartpole, SolvedLooksAtTheLastHalfSecond) {
  for (const Options& options : {Options{}, Options{.dt_s = 0.05, .horizon = 60}}) {
    const scenario::Scenario s = make(options);
    const Index T = options.horizon, first = T - std::lround(0.5 / options.dt_s);
    Episode episode{.true_states = Matrix::Zero(T + 1, 4), .actions = Matrix::Zero(T, 1)};
    EXPECT_FALSE(s.task.solved(episode));
    episode.true_states.bottomRows(T - first + 1).col(3).setConstant(M_PI);
    EXPECT_TRUE(s.task.solved(episode));
    episode.true_states(first, 3) = M_PI + 0.17;  // 9.7°
    episode.true_states(first, 0) = -0.09;
    EXPECT_TRUE(s.task.solved(episode));
    episode.true_states(first, 3) = M_PI - 0.18;  // 10.3°
    EXPECT_FALSE(s.task.solved(episode));
    episode.true_states.row(first) = Vector{{0.11, 0, 0, -M_PI}}.transpose();
    EXPECT_FALSE(s.task.solved(episode));
  }
}

TEST(Cartpole, IsDrawnWithItsEndWhereTheRewardSeesIt) {
  scenario::expect_drawn_where_rewarded(make({}), Vector{{0, 0, 0, M_PI}}, 0.25);
}

}  // namespace
}  // namespace rehearse::robots::cartpole
