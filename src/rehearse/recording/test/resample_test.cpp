#include "rehearse/recording/resample.hpp"

#include <gtest/gtest.h>

namespace rehearse::recording {
namespace {

Channel with(const std::string& name, const std::vector<std::pair<double, double>>& samples) {
  Channel channel{name, "", {}};
  for (const auto& [time_s, value] : samples)
    channel.samples.push_back({time_s, value, static_cast<Index>(channel.samples.size()) + 2});
  return channel;
}

TEST(Resample, RowsAtStepsAreTakenAsTheyAre) {
  const Channels channels{
      {with("x", {{0, 0.1}, {0.1, 0.7}, {0.30000000000000004 - 0.1, 0.3}})}, {with("u", {{0, 1.1}, {0.1, 2.3}})}, {}};
  Problems problems("f");
  const Grid grid = grid_of(channels, 0.1, 0.3, problems);
  EXPECT_TRUE(problems.empty());
  Episode episode;
  const Resampled changed = resample(channels, grid, false, episode);
  EXPECT_EQ(changed.states + changed.actions, 0);
  EXPECT_EQ(episode.states, (Matrix{{0.1}, {0.7}, {0.3}}));
  EXPECT_EQ(episode.actions, (Matrix{{1.1}, {2.3}}));
  EXPECT_EQ(episode.true_states, episode.states);
}

TEST(Resample, BetweenRowsStatesAreInterpolatedAndActionsAreMeans) {
  const Channels channels{{with("x", {{0.25, 1}, {0.75, 2}, {1.5, 3.5}, {2.5, 5.5}})},
                          {with("u", {{0.25, 4}, {0.5, 0}, {1.5, 8}, {2.5, 1}})},
                          {}};
  Problems problems("f");
  const Grid grid = grid_of(channels, 1, 3, problems);
  EXPECT_EQ(grid.start_s, 0.25);
  EXPECT_EQ(grid.steps, 2);
  Episode episode;
  const Resampled changed = resample(channels, grid, false, episode);
  EXPECT_EQ(changed.states, 2) << "the first is that of a row";
  EXPECT_EQ(changed.actions, 2) << "the first begins with a row, which does not hold";

  EXPECT_EQ(episode.states, (Matrix{{1}, {3}, {5}}));
  EXPECT_EQ(episode.actions, (Matrix{{1}, {6}}));  // 4 for 0.25 s, 0 for 0.75 s; 0 for 0.25 s, 8 for 0.75 s
}

TEST(Resample, TheLastActionHoldsUntilTheLastRow) {
  const auto steps = [](const std::vector<std::pair<double, double>>& x,
                        const std::vector<std::pair<double, double>>& u) {
    Problems problems("f");
    const Channels channels{{with("x", x)}, {with("u", u)}, {}};
    const Grid grid = grid_of(channels, 0.1, 0.3, problems);
    EXPECT_TRUE(problems.empty());
    return grid.steps;
  };
  EXPECT_EQ(steps({{0, 1}, {0.2, 1}, {0.4, 1}}, {{0, 1}, {0.2, 1}}), 4);
  EXPECT_EQ(steps({{0, 1}, {0.19, 1}, {0.4, 1}}, {{0, 1}, {0.19, 1}}), 4) << "rows are not regular";
  EXPECT_EQ(steps({{0, 1}, {0.1, 1}, {0.2, 1}, {0.3, 1}}, {{0, 1}, {0.1, 1}}), 2) << "the controller stopped before";
}

// The clock of a loop is late now and then: its first row by 40 ms here, so that the last comes too early.
TEST(Resample, AStepMayLackHalfOfTheTimeFromRowToRow) {
  const auto states_of = [](double first_s) {
    Problems problems("f");
    const Channels channels{{with("x", {{first_s, first_s}, {0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}})},
                            {with("u", {{first_s, 1}, {0.1, 1}, {0.2, 1}})},
                            {}};
    Episode episode;
    resample(channels, grid_of(channels, 0.1, 0.3, problems), false, episode);
    EXPECT_TRUE(problems.empty());
    return episode.states;
  };
  EXPECT_TRUE(states_of(0.04).isApprox(Matrix{{0.04}, {0.14}, {0.24}, {0.34}})) << "the last goes on as before";
  EXPECT_EQ(states_of(0.06).rows(), 3);
}

TEST(Resample, FastRecordingsAreAveraged) {
  Channel fast{"x", "", {}};
  for (int i = 0; i <= 40; ++i) fast.samples.push_back({0.05 * i, 3 * 0.05 * i + (i % 2 == 0 ? 0.1 : -0.1), i + 2});
  const Channels channels{{fast}, {with("u", {{0, 4}, {1, 0}})}, {}};
  Problems problems("f");
  Episode episode;
  EXPECT_EQ(resample(channels, grid_of(channels, 1, 3, problems), true, episode).states, 2);
  for (Index k = 0; k < 3; ++k) EXPECT_NEAR(episode.states(k, 0), 3 * static_cast<double>(k), 0.03);
}

TEST(Resample, LongGapsAreProblemsAndShortOnesAreNot) {
  const Channels channels{{with("x", {{0, 1}, {1, 2}, {4, 5}, {5, 6}})}, {with("u", {{0, 4}, {5, 0}})}, {}};
  Problems none("f"), found("f");
  Grid grid = grid_of(channels, 1, 5, none);
  check_gaps(channels, grid, 5, none);
  EXPECT_TRUE(none.empty());
  check_gaps(channels, grid, 2, found);
  EXPECT_FALSE(found.empty());
}

TEST(Resample, WhatComesAfterTheLastStepDoesNoHarm) {
  Channels channels{{with("x", {{0, 1}, {1, 2}, {2, 5}, {9, 6}})}, {with("u", {{0, 4}, {1, 1}, {2, 7}, {9, 0}})}, {}};
  Problems problems("f");
  Grid grid = grid_of(channels, 1, 3, problems);
  grid.steps = 2;
  cut(channels, grid);
  check_gaps(channels, grid, 3, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(channels.actions[0].samples.size(), 2U);
  Episode episode;
  resample(channels, grid, false, episode);
  EXPECT_EQ(episode.states, (Matrix{{1}, {2}, {5}}));
  EXPECT_EQ(episode.actions, (Matrix{{4}, {1}}));
}

}  // namespace
}  // namespace rehearse::recording
