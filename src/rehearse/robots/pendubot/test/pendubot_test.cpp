#include "rehearse/robots/pendubot/pendubot.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"
#include "rehearse/scenario/test/drawn_reward.hpp"
#include "rehearse/testing/check_scenario.hpp"

namespace rehearse::robots::pendubot {
namespace {

constexpr double kG = 9.82;

/// The equations once more, straight from the paper, to check the vectorised ones.
void reference(const Vector& x, double u, const Vector& p, Vector& dxdt) {
  const double m1 = p(0), m2 = p(1), l1 = p(2), l2 = p(3), b1 = p(4), b2 = p(5), difference = x(2) - x(3);
  Eigen::Matrix2d A;
  A(0, 0) = l1 * l1 * (m1 / 4 + m2) + m1 * l1 * l1 / 12;
  A(0, 1) = A(1, 0) = 0.5 * m2 * l1 * l2 * std::cos(difference);
  A(1, 1) = l2 * l2 * m2 / 4 + m2 * l2 * l2 / 12;
  const Eigen::Vector2d b{kG * l1 * std::sin(x(2)) * (0.5 * m1 + m2) -
                              0.5 * m2 * l1 * l2 * x(1) * x(1) * std::sin(difference) + u - b1 * x(0),
                          0.5 * m2 * l2 * (l1 * x(0) * x(0) * std::sin(difference) + kG * std::sin(x(3))) - b2 * x(1)};
  const double determinant = A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0);
  dxdt(0) = (A(1, 1) * b(0) - A(0, 1) * b(1)) / determinant;
  dxdt(1) = (A(0, 0) * b(1) - A(1, 0) * b(0)) / determinant;
  dxdt(2) = x(0);
  dxdt(3) = x(1);
}

const Vector kTruth{{0.5, 0.5, 0.5, 0.5, 0.1, 0.1}};

TEST(Pendubot, DerivativeIsThePapersEquation) {
  Rng rng({.purpose = Purpose::test});
  for (int i = 0; i < 100; ++i) {
    Vector x(4), phi(6), ours(4), theirs(4);
    for (double& value : x) value = rng.uniform(-8, 8);
    for (double& value : phi) value = rng.uniform(0.1, 1.2);
    const double u = rng.uniform(-3.5, 3.5);
    kernel().derivative(x.data(), &u, phi.data(), ours.data());
    reference(x, u, phi, theirs);
    EXPECT_LT((ours - theirs).norm(), 1e-11 * (1 + theirs.norm()));
  }
}

TEST(Pendubot, SimulatorIsWithin2e6OfTheAdaptiveIntegratorEverywhere) {
  const scenario::Scenario s = make({});
  const Dataset data = testing::random_episodes(s, 100);
  Matrix dX(data.size(), 4);
  s.oracle->change(data.states, data.actions, kTruth, dX);
  const double worst = (dX - data.changes).cwiseAbs().maxCoeff();
  RecordProperty("worst_error", std::to_string(worst));
  EXPECT_LT(worst, 2e-6);
  EXPECT_GT(data.states.col(1).cwiseAbs().maxCoeff(), 10) << "the episodes must visit fast motions";
}

TEST(Pendubot, KeepsTheLaws) {
  EXPECT_EQ(testing::check_scenario(make({})), std::vector<std::string>{});
  EXPECT_EQ(testing::check_scenario(make({.ode = {.start_noise = 0.001, .measurement_noise = 0.01}})),
            std::vector<std::string>{});
}

TEST(Pendubot, EveryPriorOfTableOne) {
  const scenario::Scenario s = make({});
  ASSERT_EQ(s.priors.size(), 4u);
  EXPECT_EQ(s.priors[0].parameters.values(), (Vector{{0.65, 0.5, 0.5, 0.4, 0.1, 0.1}}));
  EXPECT_EQ(s.priors[1].parameters.values(), (Vector{{0.5, 0.75, 0.5, 0.5, 0.1, 0.1}}));
  EXPECT_EQ(s.priors[2].parameters.values(), (Vector{{0.5, 0.5, 0.5, 0.25, 0.1, 0.1}}));
  EXPECT_EQ(s.priors[3].parameters.values(), (Vector{{0.65, 0.35, 0.5, 0.5, 0, 0}}));
  for (const auto& prior : s.priors)
    EXPECT_EQ(prior.parameters.of_kind(Parameter::Kind::continuous), (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(s.policy->parameters(), 81);
  EXPECT_TRUE(s.task.violations().empty());
}

TEST(Pendubot, RewardIsOneUprightAndSmallHanging) {
  const scenario::Scenario s = make({});
  Matrix X(2, 4), U = Matrix::Zero(2, 1);
  X << 0, 0, 0, 0, 0, 0, M_PI, M_PI;
  Vector rewards(2);
  s.task.reward(X, U, X, rewards);
  EXPECT_NEAR(rewards(0), 1, 1e-12);
  EXPECT_NEAR(rewards(1), std::exp(-4 / 0.5), 1e-12);
}

TEST(Pendubot, SolvedLooksAtTheLastHalfSecond) {
  const scenario::Scenario s = make({});
  Episode episode{.states = Matrix::Zero(51, 4), .true_states = Matrix::Zero(51, 4), .actions = Matrix::Zero(50, 1)};
  episode.true_states.topRows(40).rightCols(2).setConstant(M_PI);
  EXPECT_TRUE(s.task.solved(episode));
  episode.true_states.row(40).tail(2).setConstant(0.3);  // the tip is 0.3 m away
  EXPECT_FALSE(s.task.solved(episode));
}

TEST(Pendubot, IsDrawnWithItsEndWhereTheRewardSeesIt) {
  scenario::expect_drawn_where_rewarded(make({}), Vector{{0, 0, 0, 0}}, 0.5);
}

TEST(Pendubot, ItsDescriptorsSayWhereAndWhen) {
  const Task task = make({}).task;
  EXPECT_EQ(task.descriptor_labels().size(), task.descriptor_bounds.size());
  EXPECT_EQ(task.descriptor_labels()[0], "tip x at 0.8 s [m]");
  EXPECT_EQ(task.descriptor_labels()[3], "tip y at 1.65 s [m]");
  Episode episode;  // hangs, then stands from the last state on
  episode.states = episode.true_states = Vector{{0, 0, 1, 1}}.transpose().replicate(51, 1) * std::numbers::pi;
  episode.true_states.row(50).setZero();
  episode.actions = Matrix::Zero(50, 1);
  episode.rewards = Vector::Zero(50);
  EXPECT_TRUE(task.descriptor(episode).isApprox(Vector{{0, -1, 0, -1, 0, 1}}));
}

}  // namespace
}  // namespace rehearse::robots::pendubot
