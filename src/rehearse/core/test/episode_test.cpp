#include "rehearse/core/episode.hpp"

#include <gtest/gtest.h>

namespace rehearse {
namespace {

Episode episode(Index steps, double start) {
  Episode e{.states = Matrix(steps + 1, 2), .actions = Matrix(steps, 1), .rewards = Vector::Constant(steps, 0.5)};
  for (Index t = 0; t <= steps; ++t) e.states.row(t) << start + static_cast<double>(t * t), -static_cast<double>(t);
  for (Index t = 0; t < steps; ++t) e.actions(t, 0) = static_cast<double>(t);
  e.true_states = e.states.array() + 0.25;
  return e;
}

TEST(Episode, TotalRewardHoldsWhatWasCharged) {
  Episode e = episode(4, 0);
  EXPECT_EQ(e.steps(), 4);
  EXPECT_EQ(e.total_reward(), 2);
  e.charged = -3;
  EXPECT_EQ(e.total_reward(), -1);
}

TEST(Episode, ThatIsShorterIsCutShortUnlessItEnded) {
  Episode e = episode(4, 0);
  EXPECT_TRUE(e.is_cut_short(5));
  EXPECT_FALSE(e.is_cut_short(4));
  e.ended = true;
  EXPECT_FALSE(e.is_cut_short(5));
}

TEST(Episode, NumbersOfAShorterOneAreOthers) {
  const Episode e = episode(4, 0);
  EXPECT_TRUE(e.has_numbers_of(episode(4, 0)));
  EXPECT_FALSE(e.has_numbers_of(episode(4, 1)));
  EXPECT_FALSE(e.has_numbers_of(e.part(0, 3)));
  EXPECT_FALSE(e.part(0, 3).has_numbers_of(e));
}

TEST(Episode, RowsOfManyAreEvenlySpreadStretches) {
  const std::vector<Episode> logs = {episode(400, 0), episode(400, 7)};
  EXPECT_EQ(spread_rows(logs, 800, 50).size(), 800);
  EXPECT_EQ(spread_rows(logs, 10000, 50).size(), 800);
  const Dataset data = spread_rows(logs, 200, 50);
  EXPECT_EQ(data.size(), 200);
  EXPECT_EQ(data.states.row(0), logs[0].states.row(0));
  EXPECT_EQ(data.states.row(50), logs[0].states.row(350));
  EXPECT_EQ(spread_rows(std::vector<Episode>(20, episode(400, 0)), 100, 50).size(), 100) << "stretches are shorter";
  EXPECT_EQ(spread_rows({}, 100, 50).size(), 0);
}

TEST(Episode, PartsAreEpisodes) {
  Episode e = episode(5, 0);
  e.charged = -3, e.ended = true;
  const Episode part = e.part(2, 3);
  EXPECT_EQ(part.steps(), 3);
  EXPECT_EQ(part.states, e.states.bottomRows(4));
  EXPECT_EQ(part.true_states, e.true_states.bottomRows(4));
  EXPECT_EQ(part.actions, e.actions.bottomRows(3));
  EXPECT_EQ(part.total_reward(), 1.5);
  EXPECT_FALSE(part.ended);
}

TEST(Episode, SecondsAreRoundedToTheNanosecond) {
  EXPECT_EQ(seconds(3, 0.05), 0.15);
  EXPECT_NE(3 * 0.05, 0.15);
  EXPECT_EQ(seconds(3, 1.0 / 3), 1);
  EXPECT_EQ(seconds(1, 1.4e-9), 1e-9);
}

TEST(Dataset, TakesTheMeasuredSteps) {
  Dataset data;
  data.append(episode(3, 0));
  ASSERT_EQ(data.size(), 3);
  EXPECT_EQ(data.states, episode(3, 0).states.topRows(3));
  EXPECT_EQ(data.actions, episode(3, 0).actions);
  Matrix changes(3, 2);
  changes << 1, -1, 3, -1, 5, -1;
  EXPECT_EQ(data.changes, changes);
  EXPECT_EQ(data.rewards, episode(3, 0).rewards);
}

TEST(Dataset, GrowsEpisodeByEpisode) {
  Dataset data;
  EXPECT_EQ(data.size(), 0);
  data.append(episode(3, 0));
  data.append(episode(2, 100));
  ASSERT_EQ(data.size(), 5);
  EXPECT_EQ(data.states(2, 0), 4);
  EXPECT_EQ(data.states(3, 0), 100) << "no step leads from one episode into the next";
  EXPECT_EQ(data.changes(2, 0), 5);
  EXPECT_EQ(data.changes(3, 0), 1);
  EXPECT_EQ(data.rewards.size(), 5);
  data.append(episode(0, 5));
  EXPECT_EQ(data.size(), 5);
}

}  // namespace
}  // namespace rehearse
