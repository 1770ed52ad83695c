#include "rehearse/scenario/ode_scenario.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "oscillator.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::scenario {
namespace {

TEST(OdeScenario, PlantIntegratesTheEquationAndOracleIsItsKernel) {
  const Scenario s = oscillator::make({.omega = 2.5});
  EXPECT_EQ(s.name, "oscillator");
  const auto plant = s.make_plant();
  Rng rng({});
  EXPECT_EQ(plant->reset(rng), s.task.start_mean);
  const Vector x = plant->step(Vector{{0}});
  EXPECT_NEAR(x(0), std::cos(0.25), 1e-10);
  EXPECT_NEAR(x(1), -2.5 * std::sin(0.25), 1e-10);

  Matrix dX(1, 2);
  const ParameterSpace& space = s.oracle->parameters();
  s.oracle->change(Matrix{{1, 0}}, Matrix{{0}}, space.values(), dX);
  EXPECT_EQ(dX, (Matrix{{0, -0.1 * 2.5 * 2.5}})) << "Euler's step, at the plant's parameters";
  EXPECT_FALSE(space.has_tunable());
}

TEST(OdeScenario, PriorsKeepTheirValuesAndWhatMayBeTuned) {
  const Scenario s = oscillator::make({});
  ASSERT_EQ(s.priors.size(), 2u);
  EXPECT_EQ(s.priors[0].name, "slow");
  EXPECT_EQ(s.priors[0].parameters.values(), Vector{{2}});
  EXPECT_TRUE(s.priors[0].parameters.has_tunable());
  EXPECT_FALSE(s.priors[1].parameters.has_tunable());
  Matrix dX(1, 2);
  s.priors[1].simulator->change(Matrix{{1, 0}}, Matrix{{0}}, s.priors[1].parameters.values(), dX);
  EXPECT_DOUBLE_EQ(dX(0, 1), -1.6);
}

TEST(OdeScenario, MeasurementsAreNoisyAndTheTruthIsNot) {
  oscillator::Options options;
  options.ode.measurement_noise = 0.1;
  const auto plant = oscillator::make(options).make_plant();
  Rng rng({});
  const Vector measured = plant->reset(rng);
  EXPECT_EQ(plant->truth(), (Vector{{1, 0}}));
  EXPECT_NE(measured(0), 1);
  EXPECT_NE(measured(1), 0);
}

TEST(OdeScenario, OptionsReachTheirParts) {
  oscillator::Options options;
  for (const auto& [name, text] : {std::pair{"start_noise", "0.2"}, {"box_low", "1.5"}, {"policy", "linear"}})
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { options.fields(v); }, name, text)) << name;
  const Scenario s = oscillator::make(options);
  EXPECT_EQ(s.task.start_std, (Vector{{0.2, 0.2}}));
  EXPECT_EQ(s.priors[0].parameters[0].box.low, 1.5);
  EXPECT_EQ(s.policy->name(), "linear");
  Matrix U(1, 1);  // θ · (x / scale), squashed into [−2, 1]
  s.policy->act(Matrix{{0, 0.3, 0}}, Matrix{{0, 4}}, 0, U);
  EXPECT_NEAR(U(0, 0), -0.5 + 1.5 * std::tanh(0.6), 1e-14);
}

TEST(OdeScenario, ABoxWithoutRoomIsRefusedOnce) {
  for (const auto& [low, text] : {std::pair{7.5, "7.5"}, {5.0, "5"}}) {
    oscillator::Options options;  // with box_high = 5
    options.ode.box_low = low;
    try {
      oscillator::make(options);
      ADD_FAILURE() << "box_low = " << low;
    } catch (const InvalidInput& error) {
      EXPECT_EQ(std::string(error.what()), std::string("box_low = ") + text + ", must be < box_high = 5");
    }
  }
}

TEST(LimitWithin, HoldsWhereAStateIsNearerToZero) {
  const Limit limit = limit_within({"v", "m/s"}, 1, 0.5, 0.1);
  EXPECT_EQ(limit.name, "v");
  EXPECT_EQ(limit.text, "abs(v) < 0.5 m/s");
  EXPECT_EQ(limit.risk, 0.1);
  const Matrix X{{9, 0.4}, {9, -0.4}, {9, 0.5}, {9, -0.6}, {9, std::nan("")}};
  Vector kept(5);
  const Matrix U = Matrix::Zero(5, 1);
  limit.holds({X, U, X, U}, kept);
  EXPECT_EQ(kept, (Vector{{1, 1, 0, 0, 0}}));
}

TEST(HoldsAtTheEnd, LooksAtEveryStateOfTheLastSeconds) {
  const Task task = oscillator::task({.horizon = 10});
  const auto solved = holds_at_the_end(task, 0.3, each_state([](const ConstVectorView& x) { return x(0) > 0; }));
  Episode episode{.true_states = Matrix::Constant(11, 2, -1), .actions = Matrix::Zero(10, 1)};
  episode.true_states.col(0).tail(4).setOnes();  // x_7..x_10
  EXPECT_TRUE(solved(episode));
  for (const Index t : {7, 8, 10}) {
    Episode fails = episode;
    fails.true_states(t, 0) = -1;
    EXPECT_FALSE(solved(fails)) << t;
  }
  Episode fell = episode;
  fell.ended = true;
  EXPECT_FALSE(solved(fell));
  Episode cut{.true_states = Matrix::Ones(10, 2), .actions = Matrix::Zero(9, 1)};
  EXPECT_FALSE(solved(cut));
}

TEST(InitialReward, HasTheWidthThatIsAskedFor) {
  const auto squared_distance = [](const ConstMatrixView& X, VectorView d2) { d2 = X.col(0).array().square(); };
  EXPECT_FALSE(initial_reward(squared_distance, {}));
  Vector reward(1);
  const Matrix x{{3, 0}}, u{{0}};
  initial_reward(squared_distance, {.initial_reward_width = 2})(x, u, x, reward);
  EXPECT_NEAR(reward(0), std::exp(-9.0 / 8), 1e-15);
}

TEST(HoldsAtTheEnd, OfAShortEpisodeLooksAtAll) {
  const auto solved =
      holds_at_the_end(oscillator::task({.horizon = 2}), 1, each_state([](const auto& x) { return x(0) > 0; }));
  Episode episode{.true_states = Matrix::Ones(3, 2), .actions = Matrix::Zero(2, 1)};
  EXPECT_TRUE(solved(episode));
  episode.true_states(0, 0) = -1;
  EXPECT_FALSE(solved(episode));
}

}  // namespace
}  // namespace rehearse::scenario
