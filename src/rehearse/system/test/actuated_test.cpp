#include "rehearse/system/actuated.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/task.hpp"
#include "rehearse/system/simulated_plant.hpp"
#include "rehearse/testing/check_plant.hpp"
#include "rehearse/testing/check_simulator.hpp"

namespace rehearse::system {
namespace {

constexpr double kDt = 0.1;

Actuators actuators(const Actuation& actuation, Index own_states) {
  return {{{.name = "u", .bounds = {-1, 1}, .actuation = actuation}}, kDt, own_states};
}

/// A mass on a line that is moved by phi · u.
std::shared_ptr<const Simulator> mass_on_a_line() {
  return make_simulator(ParameterSpace({Parameter::fixed("gain", 3, "")}),
                        [](const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
                          dX.col(0) = kDt * X.col(1);
                          dX.col(1) = kDt * phi(0) * U.col(0);
                        });
}

std::unique_ptr<Plant> plant_of(const Actuators& task, const Actuators& own) {
  const auto motion = [](const Vector& x, const Vector& u) -> Vector {
    return x + Vector{{kDt * x(1), kDt * 3 * u(0)}};
  };
  return with_actuators(make_simulated_plant(motion, {Vector::Zero(2), Vector::Constant(2, 0.1), {}}), task, own);
}

TEST(ActuatedSimulator, AsksTheRobotWhatMovesIt) {
  const auto simulator = with_actuators(mass_on_a_line(), actuators({.delay_s = 2 * kDt}, 2));
  Matrix X(2, 4), U(2, 1), dX(2, 4);
  X << 1, 2, 0.1, 0.2, 3, 4, -0.3, -0.4;
  U << 1, -1;
  simulator->change(X, U, Vector{{3.0}}, dX);
  const Matrix expected = (Matrix(2, 4) << 0.2, 0.06, 0.9, -0.1, 0.4, -0.12, -0.7, 0.1).finished();
  EXPECT_TRUE(dX.isApprox(expected, 1e-14)) << dX;
  EXPECT_EQ(simulator->behind_actuators()->parameters().names(), simulator->parameters().names());
  EXPECT_EQ(testing::check_simulator(*simulator, X, U, Vector{{3.0}}), std::vector<std::string>());
}

TEST(ActuatedPlant, DoesWhatTheSimulatorDoes) {
  const Actuation actuation{.max_rate = 5, .delay_s = 1.4 * kDt, .lag_s = 0.06};
  const auto simulator = with_actuators(mass_on_a_line(), actuators(actuation, 2));
  const auto plant = plant_of(actuators(actuation, 2), actuators(actuation, 0));
  Rng rng({.seed = 1});
  Vector x = plant->reset(rng);
  Matrix dX(1, 5);
  ASSERT_EQ(x.size(), 5);
  for (Index t = 0; t < 12; ++t) {
    const Vector u{{std::sin(static_cast<double>(t))}};
    simulator->change(x.transpose(), u.transpose(), Vector{{3.0}}, dX);
    const Vector next = plant->step(u);
    EXPECT_TRUE(next.isApprox(x + dX.transpose(), 1e-13));
    EXPECT_EQ(plant->truth(), next);
    x = next;
  }
}

TEST(ActuatedPlant, MayHaveActuatorsThatTheTaskDoesNotKnow) {
  const auto plant = plant_of(actuators({}, 2), actuators({.delay_s = 3 * kDt}, 0));
  Rng rng({.seed = 1});
  const Vector start = plant->reset(rng);
  ASSERT_EQ(start.size(), 2);
  for (int t = 0; t < 3; ++t) EXPECT_EQ(plant->step(Vector{{1.0}})(1), start(1));
  EXPECT_NEAR(plant->step(Vector{{1.0}})(1), start(1) + 0.3, 1e-14);
}

TEST(ActuatedPlant, OfARobotThatHasItsOwnDelayOnlyRemembers) {
  const auto plant = plant_of(actuators({.delay_s = 2 * kDt}, 2), actuators({}, 0));
  Rng rng({.seed = 1});
  const Vector start = plant->reset(rng);
  const Vector next = plant->step(Vector{{1.0}});
  EXPECT_NEAR(next(1), start(1) + 0.3, 1e-14);
  EXPECT_EQ(next.tail(2), (Vector{{1, 0}}));
}

TEST(ActuatedPlant, KeepsTheLawsOfPlants) {
  const Actuation actuation{.delay_s = kDt, .lag_s = 0.02};
  Task task;
  task.states = {{"x", "m"}, {"dx", "m/s"}};
  task.actions = {{.name = "u", .bounds = {-1, 1}, .actuation = actuation}};
  task.start_mean = Vector::Zero(2);
  task.start_std = Vector::Constant(2, 0.1);
  task.dt_s = kDt;
  task.horizon = 20;
  task = with_memory(task);
  const auto make = [&] { return plant_of(task.actuators(), actuators(actuation, 0)); };
  EXPECT_EQ(testing::check_plant(make, task), std::vector<std::string>());
}

}  // namespace
}  // namespace rehearse::system
