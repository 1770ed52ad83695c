// Records of simulations.

#include <cmath>

#include <gtest/gtest.h>

#include "cart_rollouts.hpp"

namespace rehearse::rollout {
namespace {

using cart::kKey, cart::kUnclipped, cart::Noise, cart::noise_of, cart::simulate_cart, cart::start_of;

TEST(SimulateRecorded, HasTheReturnsAndTheStatesOfSimulate) {
  const Task task = cart::task();
  const Matrix theta = cart::candidates(1);
  const Recorded recorded = simulate_recorded({cart::Model(0.01), *cart::policy(), task, kKey, kUnclipped}, theta, 4);
  ASSERT_EQ(recorded.states.size(), 21u);
  EXPECT_EQ(Matrix(recorded.returns), simulate_cart(task, theta, 4, kUnclipped, cart::Model(0.01)).returns);
  for (Index p = 0; p < 4; ++p) {
    const Noise noise = noise_of(task, 0, static_cast<std::uint64_t>(p));
    const Matrix states = cart::by_hand(task, theta, start_of(task, noise), noise.steps, 0.1).states;
    for (std::size_t t = 0; t <= 20; ++t)
      EXPECT_LT((recorded.states[t].row(p) - states.row(static_cast<Index>(t))).norm(), 1e-12);
  }
  EXPECT_LT((recorded.rewards.rowwise().sum() - recorded.returns).norm(), 1e-12);
}

TEST(SimulateRecorded, AfterAnEarlyEndARowIsNan) {
  Task task = cart::task(0);
  task.ended = each_state([](const ConstVectorView& x) { return x(1) < 0.9; });
  Vector left = Vector::Zero(13);
  left(12) = -5;  // the bias of the output: full force to the left
  const Recorded recorded = simulate_recorded({cart::Model(), *cart::policy(), task, kKey}, left, 2);
  bool ended = false;
  for (const Matrix& states : recorded.states) {
    ended = ended || states.array().isNaN().any();
    EXPECT_TRUE(ended ? states.array().isNaN().all() : states.array().isFinite().all());
  }
  EXPECT_TRUE(ended);
  EXPECT_LT((recorded.rewards.rowwise().sum() - recorded.returns).norm(), 1e-12);
  EXPECT_TRUE((recorded.rewards.rightCols(1).array() == 0).all()) << "charged when it ended";
}

TEST(SimulateEpisodes, NumbersStartAgainAfterAPeriod) {
  const Task task = cart::task();
  const cart::Model uncertain(0.01);
  const Matrix Theta = cart::candidates(1).transpose().replicate(4, 1);
  Episodes episodes;
  simulate_episodes({uncertain, *cart::policy(), task, kKey}, Theta, {.first = 5, .period = 2}, episodes);
  EXPECT_EQ(episodes.returns.head(2), episodes.returns.tail(2));
  EXPECT_NE(episodes.returns(0), episodes.returns(1));
}

/// Rows that fail at v > 0.5, and that fall at p < 0.8.
TEST(SimulateEpisodes, RecordsWhatTheReturnsAreMadeOf) {
  Task task = cart::task();
  const cart::Model model(0.01, [](double v, double) { return v > 0.5; });
  const Matrix Theta = cart::candidates(40);
  for (const bool falls : {false, true}) {
    if (falls) task.ended = each_state([](const ConstVectorView& x) { return x(1) < 0.8; });
    const Simulated simulated = simulate_cart(task, Theta, 1, {}, model, 5);
    Episodes episodes;
    simulate_episodes({model, *cart::policy(), task, kKey}, Theta.transpose(), {5}, episodes);
    EXPECT_EQ(episodes.returns, simulated.returns.row(0).transpose());
    Index failed = 0, ended = 0, whole = 0;
    for (Index row = 0; row < 40; ++row) {
      Episode episode;
      episodes.copy(row, episode);
      EXPECT_NEAR(episode.total_reward(), simulated.returns(0, row), 1e-12);
      const Index T = episode.steps();
      ASSERT_EQ(episode.states.rows(), T + 1);
      EXPECT_TRUE(episode.states.allFinite() && episode.rewards.allFinite());
      for (Index t = 0; t < T; ++t) EXPECT_EQ(episode.rewards(t), std::exp(-std::pow(episode.states(t + 1, 1), 2)));
      const bool fell = T > 0 && task.ended && episode.states(T, 1) < 0.8;
      EXPECT_EQ(episodes.failed[static_cast<std::size_t>(row)], T < 20 && !fell);
      EXPECT_EQ(episode.ended, T < 20 || fell);
      EXPECT_EQ(episode.charged, (20 - T) * -0.5);
      failed += episodes.failed[static_cast<std::size_t>(row)];
      ended += fell;
      whole += T == 20;
    }
    EXPECT_EQ(failed, simulated.failed);
    EXPECT_GT(failed, 0);
    EXPECT_GT(whole, 0);
    EXPECT_EQ(ended > 0, falls);
  }
}

}  // namespace
}  // namespace rehearse::rollout
