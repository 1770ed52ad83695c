// Actuators on the plant and in models: commands follow from each other in every loop over time.

#include <gtest/gtest.h>

#include "cart.hpp"
#include "rehearse/dynamics/actuated_model.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/rollout/simulate.hpp"
#include "rehearse/system/actuated.hpp"
#include "rehearse/system/simulated_plant.hpp"

namespace rehearse::rollout {
namespace {

const Actuation kActuation{.max_rate = 4, .filter_s = 0.05, .delay_s = 0.16, .lag_s = 0.1};

Task actuated_cart() {
  Task task = cart::task(0);
  task.actions[0].actuation = kActuation;
  return with_memory(task);
}

std::shared_ptr<const policy::Policy> policy_of(const Task& task) {
  const FeatureMap features = task.feature_map();
  return policy::make_mlp(
      {.features = features, .scale = Vector::Ones(features.features()), .hidden = 3, .squash = {{{-2, 2}}, 5}});
}

std::unique_ptr<system::Plant> plant_of(const Task& task) {
  const auto motion = [](const Vector& x, const Vector& u) -> Vector { return x + Vector{{0.1 * u(0), 0.1 * x(0)}}; };
  auto cart = system::make_simulated_plant(motion, {Vector{{0, 1}}, Vector::Zero(2), {}});
  return system::with_actuators(std::move(cart), task.actuators(), Actuators(task.actions, task.dt_s, 0));
}

Vector some_theta(const policy::Policy& policy) {
  Rng rng({.seed = 3});
  Vector theta(policy.parameters());
  for (double& value : theta) value = rng.uniform(-2, 2);
  return theta;
}

TEST(ActuatedRollouts, AreThePlantsEpisode) {
  const Task task = actuated_cart();
  const auto policy = policy_of(task);
  const Vector theta = some_theta(*policy);
  const auto plant = plant_of(task);
  const Episode episode = execute(*plant, *policy, theta, task, Rng({.seed = 1}));
  ASSERT_EQ(episode.steps(), task.horizon);
  const dynamics::ActuatedModel model(std::make_shared<cart::Model>(), task.actuators());
  const Recorded recorded = simulate_recorded({.model = model, .policy = *policy, .task = task}, theta, 1);
  for (Index t = 0; t <= task.horizon; ++t)
    EXPECT_TRUE(recorded.states[static_cast<std::size_t>(t)].row(0).isApprox(episode.states.row(t), 1e-12)) << t;
  Episodes episodes;
  simulate_episodes({.model = model, .policy = *policy, .task = task}, theta.transpose(), {}, episodes);
  for (Index t = 0; t < task.horizon; ++t)
    EXPECT_NEAR(episodes.actions[static_cast<std::size_t>(t)](0, 0), episode.actions(t, 0), 1e-12);
}

TEST(ActuatedRollouts, RecordCommandsThatKeepTheRate) {
  const Task task = actuated_cart();
  const auto policy = policy_of(task);
  const auto plant = plant_of(task);
  const Episode episode = execute(*plant, *policy, some_theta(*policy), task, Rng({.seed = 1}));
  double before = 0, fastest = 0;
  for (Index t = 0; t < episode.steps(); ++t) {
    fastest = std::max(fastest, std::abs(episode.actions(t, 0) - before));
    before = episode.actions(t, 0);
  }
  EXPECT_LE(fastest, 4 * task.dt_s * (1 + 1e-12));
  EXPECT_GT(fastest, 3.9 * task.dt_s) << "the policy wants more";
  EXPECT_EQ(task.actuators().memory_of(episode.actions), episode.states.rightCols(task.memory));
}

TEST(ActuatedRollouts, AreThoseOfASimulatorInThePlaceOfThePlant) {
  const Task task = actuated_cart();
  const auto policy = policy_of(task);
  const Vector theta = some_theta(*policy);
  const auto cart =
      system::make_simulator({}, [](const ConstMatrixView& X, const ConstMatrixView& U, const Vector&, MatrixView dX) {
        dX.col(0) = 0.1 * U.col(0);
        dX.col(1) = 0.1 * X.col(0);
      });
  const auto simulator = system::with_actuators(cart, task.actuators());
  const Episode simulated = execute({simulator, Vector()}, *policy, theta, task, Rng({.seed = 1}));
  const auto plant = plant_of(task);
  const Episode episode = execute(*plant, *policy, theta, task, Rng({.seed = 1}));
  EXPECT_TRUE(simulated.states.isApprox(episode.states, 1e-12));
  EXPECT_TRUE(simulated.actions.isApprox(episode.actions, 1e-12));
}

}  // namespace
}  // namespace rehearse::rollout
