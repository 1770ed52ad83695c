// Rewards of whole episodes: Task::episode_reward.

#include <cmath>

#include <gtest/gtest.h>

#include "cart_rollouts.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/system/simulated_plant.hpp"

namespace rehearse::rollout {
namespace {

using cart::kKey, cart::simulate_cart;

/// The largest position, and ten for each step that was made.
double of_whole_episode(const Episode& episode) {
  return episode.true_states.col(1).maxCoeff() + 10 * static_cast<double>(episode.steps());
}

// Some rows fall at p < 0.8, others fail at v > 0.5.
TEST(EpisodeRewards, AreAddedToEverySimulatedReturn) {
  Task task = cart::task();
  task.ended = each_state([](const ConstVectorView& x) { return x(1) < 0.8; });
  const cart::Model model(0.01, [](double v, double) { return v > 0.5; });
  const Matrix Theta = cart::candidates(40);
  Episodes before, after;
  simulate_episodes({model, *cart::policy(), task, kKey}, Theta.transpose(), {}, before);
  task.episode_reward = of_whole_episode;
  simulate_episodes({model, *cart::policy(), task, kKey}, Theta.transpose(), {}, after);
  EXPECT_EQ(simulate_cart(task, Theta, 1, {}, model).returns.row(0).transpose(), after.returns);
  Episode episode;
  for (Index row = 0; row < 40; ++row) {
    after.copy(row, episode);
    EXPECT_EQ(episode.episode_reward, of_whole_episode(episode));
    EXPECT_EQ(after.returns(row), before.returns(row) + episode.episode_reward);
    EXPECT_NEAR(episode.total_reward(), after.returns(row), 1e-12);
  }
  EXPECT_EQ(simulate_recorded({model, *cart::policy(), task, kKey}, Theta.col(0), 1).returns(0), after.returns(0));
  task.episode_reward = nullptr;
  simulate_episodes({model, *cart::policy(), task, kKey}, Theta.transpose(), {}, after);
  EXPECT_EQ(after.returns, before.returns) << "the next task has none";
  after.copy(0, episode);
  EXPECT_EQ(episode.episode_reward, 0);
}

TEST(EpisodeRewards, AreAddedOnThePlantAndToToldEpisodes) {
  Task task = cart::task();
  task.episode_reward = of_whole_episode;
  const auto motion = [](const Vector& x, const Vector& u) -> Vector { return x + Vector{{0.1 * u(0), 0.1 * x(0)}}; };
  const auto plant = system::make_simulated_plant(motion, {task.start_mean, Vector::Zero(2), {}});
  Episode episode = execute(*plant, *cart::policy(), cart::candidates(1), task, Rng({.seed = 5}));
  EXPECT_EQ(episode.episode_reward, of_whole_episode(episode));
  EXPECT_EQ(episode.total_reward(), episode.rewards.sum() + episode.episode_reward);
  EXPECT_EQ(judged(episode, task).total_reward(), episode.total_reward());
  episode.states.array() += 0.5;
  EXPECT_NEAR(as_measured(episode, task).episode_reward, episode.episode_reward + 0.5, 1e-12);
}

TEST(EpisodeRewards, ThatAreNotFiniteAreTheFloorAndAFailure) {
  Task task = cart::task(0);
  task.episode_reward = [](const Episode&) { return std::nan(""); };
  const auto motion = [](const Vector& x, const Vector&) -> Vector { return x; };
  const auto plant = system::make_simulated_plant(motion, {task.start_mean, Vector::Zero(2), {}});
  const Episode episode = execute(*plant, *cart::policy(), cart::candidates(1), task, Rng({.seed = 5}));
  EXPECT_EQ(episode.steps(), task.horizon);
  EXPECT_EQ(episode.failure, "the reward of the whole episode is not finite");
  EXPECT_EQ(episode.total_reward(), episode.rewards.sum() + task.reward_floor);
  const Matrix simulated = simulate_cart(task, cart::candidates(1), 1).returns;
  task.episode_reward = nullptr;
  EXPECT_EQ(simulated(0, 0), simulate_cart(task, cart::candidates(1), 1).returns(0, 0) + task.reward_floor);
}

}  // namespace
}  // namespace rehearse::rollout
