// Known actuators are not learned: models are of the robot behind them.

#include <gtest/gtest.h>

#include "learn_swing.hpp"
#include "rehearse/system/actuated.hpp"

namespace rehearse::identification {
namespace {

const Actuators& swing_actuators() {
  static const Actuators actuators({{.name = "u", .bounds = {-1, 1}, .actuation = {.delay_s = 0.15, .lag_s = 0.05}}},
                                   0.1, 2);
  return actuators;
}

prior::Prior behind_actuators(prior::Prior prior) {
  prior.simulator = system::with_actuators(prior.simulator, swing_actuators());
  return prior;
}

FeatureMap features_with_memory() {
  return FeatureMap({StateKind::plain, StateKind::angle, StateKind::plain, StateKind::plain, StateKind::plain});
}

/// Steps of the true swing behind its actuators, from any memory.
Dataset actuated_data(Index n, std::uint64_t seed) {
  const Dataset swing = swing::data(n, seed);
  Rng rng({.seed = seed + 100});
  Dataset data{.states = Matrix(n, 5), .actions = swing.actions, .changes = Matrix(n, 5)};
  data.states.leftCols(2) = swing.states;
  for (double& value : data.states.rightCols(3).reshaped()) value = rng.uniform(-1, 1);
  const prior::Prior truth = behind_actuators(swing::prior_at(swing::kTruth));
  truth.mean(data.states, data.actions, swing::kTruth, data.changes);
  return data;
}

Matrix errors_of(const Learned& learned, const Dataset& data) {
  Matrix mean(data.size(), 5);
  learned.model->predict_mean(data.states, data.actions, mean);
  return mean - data.changes;
}

// Seeds 1 and 2, 100 rows to learn from and 200 to predict; no noise, as in learn_test.cpp.
TEST(LearnActuated, ZeroMeanPredictsAsWellAsWithoutActuators) {
  const Dataset data = actuated_data(100, 1), held_out = actuated_data(200, 2);
  const Learned learned =
      learn({data, features_with_memory(), {}, nullptr, swing_actuators()}, ZeroMean{}, {}, serial_evaluator());
  const Matrix errors = errors_of(learned, held_out);
  EXPECT_LT(swing::rms(errors.leftCols(2)), 0.03 * swing::rms(held_out.changes.leftCols(2)));
  EXPECT_EQ(errors.rightCols(3), Matrix::Zero(200, 3)) << "what is remembered is known";
  EXPECT_EQ(learned.state.kernels.size(), 2U) << "one a state of the robot";
  EXPECT_EQ(learned.state.kernels.front().inputs(), 4) << "its features, and what moves it";
}

TEST(LearnActuated, ParametersAreThoseOfTheRobot) {
  const Dataset data = actuated_data(60, 1), held_out = actuated_data(100, 2);
  const prior::Prior prior = behind_actuators(swing::prior({swing::length(), swing::friction()}));
  for (const Kind& kind : {Kind(Mi{}), Kind(GpMi{})}) {
    const Learned learned =
        learn({data, features_with_memory(), {}, &prior, swing_actuators()}, kind, {}, serial_evaluator());
    EXPECT_TRUE(learned.state.phi->isApprox(swing::kTruth, 1e-5)) << learned.state.phi->transpose();
    EXPECT_LT(swing::rms(errors_of(learned, held_out)), 1e-5);
  }
}

TEST(LearnActuated, OneOfSeveralPriors) {
  const Dataset data = actuated_data(60, 1);
  prior::Prior wrong = behind_actuators(swing::prior({swing::length(0.3), Parameter::fixed("friction", 0.9, "")}));
  wrong.name = "wrong";
  const prior::Prior both =
      prior::choice({wrong, behind_actuators(swing::prior({swing::length(), swing::friction()}))});
  const Learned learned =
      learn({data, features_with_memory(), {}, &both, swing_actuators()}, GpMi{}, {}, serial_evaluator());
  EXPECT_EQ((*learned.state.phi)(0), 1) << "the second is the robot's";
}

}  // namespace
}  // namespace rehearse::identification
