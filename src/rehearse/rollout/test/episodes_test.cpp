#include "rehearse/rollout/episodes.hpp"

#include <gtest/gtest.h>

namespace rehearse::rollout {
namespace {

/// Two episodes of up to 3 steps: the first falls after 2, the second is whole.
Episodes two_episodes() {
  Episodes all;
  for (const double t : {0, 1, 2, 3}) all.states.push_back(Matrix{{t, 10 + t}, {20 + t, 30 + t}});
  for (const double t : {0, 1, 2}) all.actions.push_back(Matrix{{-t}, {-10 - t}});
  all.rewards = Matrix{{1, 2, 0}, {4, 5, 6}};
  all.returns = Vector{{1 + 2 - 0.5, 15}};
  all.steps = {2, 3};
  all.ended = {1, 0};
  all.failed = {0, 0};
  all.reward_floor = -0.5;
  return all;
}

TEST(Episodes, AreCopiedARowAtATime) {
  const Episodes all = two_episodes();
  Episode episode;
  all.copy(1, episode);
  EXPECT_EQ(episode.states, (Matrix{{20, 30}, {21, 31}, {22, 32}, {23, 33}}));
  EXPECT_EQ(episode.true_states, episode.states);
  EXPECT_EQ(episode.actions, (Matrix{{-10}, {-11}, {-12}}));
  EXPECT_EQ(episode.rewards, (Vector{{4, 5, 6}}));
  EXPECT_FALSE(episode.ended);
  EXPECT_EQ(episode.total_reward(), all.returns(1));
}

TEST(Episodes, AnEarlyEndIsChargedAndLeavesOutWhatCameAfterIt) {
  const Episodes all = two_episodes();
  Episode episode;
  all.copy(1, episode);
  all.copy(0, episode);  // into one that is longer
  EXPECT_EQ(episode.states, (Matrix{{0, 10}, {1, 11}, {2, 12}}));
  EXPECT_EQ(episode.actions, (Matrix{{0}, {-1}}));
  EXPECT_EQ(episode.rewards, (Vector{{1, 2}}));
  EXPECT_TRUE(episode.ended);
  EXPECT_EQ(episode.charged, -0.5);
  EXPECT_EQ(episode.total_reward(), all.returns(0));
}

}  // namespace
}  // namespace rehearse::rollout
