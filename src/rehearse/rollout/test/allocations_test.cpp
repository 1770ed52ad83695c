// The time loop allocates nothing: an episode of twice the length takes as many allocations.

#include <gtest/gtest.h>

#include "cart.hpp"
#include "rehearse/dynamics/actuated_model.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/identification/learned_reward.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"
#include "rehearse/rollout/simulate.hpp"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include "rehearse/core/test/counted_allocations.hpp"

namespace rehearse::rollout {
namespace {

/// The allocations of the second of two calls: a thread's buffers grow once.
long allocations_of(const dynamics::DynamicsModel& model, const policy::Policy& policy, Task task, Index horizon) {
  task.horizon = horizon;
  const Matrix Theta = Matrix::Constant(policy.parameters(), 60, 0.3);
  const auto call = [&] { return simulate({model, policy, task}, Theta, {0, 2}, serial_evaluator()); };
  call();
  const long before = allocations;
  call();
  return allocations - before;
}

void expect_none_in_time_loop(const dynamics::DynamicsModel& model, const policy::Policy& policy, const Task& task) {
  EXPECT_GT(allocations_of(model, policy, task, 50), 0) << "the count works";
  EXPECT_EQ(allocations_of(model, policy, task, 50), allocations_of(model, policy, task, 100));
}

TEST(Allocations, NoneInTheTimeLoop) { expect_none_in_time_loop(cart::Model(0.01), *cart::policy(), cart::task()); }

TEST(Allocations, NoneBehindActuators) {
  Task task = cart::task();
  task.actions[0].actuation = {.max_rate = 9, .filter_s = 0.1, .delay_s = 0.25, .lag_s = 0.1};
  task = with_memory(task);
  const FeatureMap features = task.feature_map();
  const auto policy = policy::make_mlp({.features = features,
                                        .scale = Vector::Ones(features.features()),
                                        .hidden = 3,
                                        .squash = {task.action_bounds(), 1}});
  expect_none_in_time_loop(dynamics::ActuatedModel(std::make_shared<cart::Model>(0.01), task.actuators()), *policy,
                           task);
}

TEST(Allocations, NoneWhereRolloutsMayEndEarly) {
  Task task = cart::task();
  task.ended = each_state([](const ConstVectorView& x) { return std::abs(x(1)) > 1e3; });
  expect_none_in_time_loop(cart::Model(0.01), *cart::policy(), task);
}

TEST(Allocations, NoneWithALearnedReward) {
  Dataset data{.states = Matrix::Random(30, 2), .actions = Matrix::Random(30, 1), .changes = Matrix::Random(30, 2)};
  identification::RewardOptions options;
  options.scale = identification::RewardScale::logarithmic;
  for (const double least : {-1.0, 0.1}) {  // learned linearly, and by the logarithm
    data.rewards = Vector::LinSpaced(30, least, 1);
    Task task = cart::task();
    task.reward = identification::learn_reward(data, task.feature_map(), options).reward;
    expect_none_in_time_loop(cart::Model(0.01), *cart::policy(), task);
  }
}

gp::Posterior posterior(const FeatureMap& features) {
  const Matrix X = Matrix::Random(30, features.features() + 1), Y = Matrix::Random(30, 4);
  const gp::Hyperparameters kernel{.log_lengths = Vector::Zero(X.cols()), .log_signal = -2, .log_noise = -4};
  return {gp::Inputs(X), Y, std::vector(4, kernel)};
}

TEST(Allocations, NoneWithThePendubotsGpsAndPriors) {
  const scenario::Scenario pendubot = robots::pendubot::make({});
  const FeatureMap features = pendubot.task.feature_map();
  std::vector<prior::Prior> priors;
  for (const scenario::NamedPrior& p : pendubot.priors) priors.push_back({p.name, p.simulator, p.parameters});
  for (const prior::Prior& prior : {priors[2], prior::choice(priors)})
    for (const auto variance : {dynamics::PredictedVariance::latent, dynamics::PredictedVariance::noisy})
      for (const Vector& measurement_std : {Vector(), Vector(Vector::Constant(4, 0.01))}) {
        dynamics::GpModel model(features, pendubot.task.kinematics(), dynamics::Mean{prior, prior.space.values()},
                                posterior(features), variance);
        model.set_measurement_std(measurement_std);
        expect_none_in_time_loop(model, *pendubot.policy, pendubot.task);
      }
}

}  // namespace
}  // namespace rehearse::rollout

#endif
