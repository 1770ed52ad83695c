#include "rehearse/study/log_model.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/study/test/swings.hpp"

namespace rehearse::study {
namespace {

TEST(LogModel, RowsAreEvenlySpreadStretches) {
  const std::vector<Episode> logs = {swinging_log(1, 0).episode, swinging_log(2, 0).episode};
  EXPECT_EQ(spread_rows(logs, 800, 50).size(), 800);
  EXPECT_EQ(spread_rows(logs, 10000, 50).size(), 800);
  const Dataset data = spread_rows(logs, 200, 50);
  EXPECT_EQ(data.size(), 200);
  EXPECT_EQ(data.states.row(0), logs[0].states.row(0));
  EXPECT_EQ(data.states.row(50), logs[0].states.row(350));
}

TEST(LogModel, ManyLogsHaveShortStretches) {
  const std::vector<Episode> logs(20, swinging_log(1, 0).episode);
  EXPECT_EQ(spread_rows(logs, 100, 50).size(), 100);
}

TEST(LogModel, StatesAreFoundByName) {
  EXPECT_EQ(states_named("q,dq", swinging_task()), (std::vector<Index>{1, 0}));
  EXPECT_TRUE(states_named("", swinging_task()).empty());
  EXPECT_THROW(states_named("p", swinging_task()), InvalidInput);
}

TEST(LogModel, RootMeanSquaresLeaveOutWhatIsNotFinite) {
  EXPECT_TRUE(root_mean_squares(Matrix{{3, 1}, {-3, NAN}, {3, INFINITY}}).isApprox(Vector{{3, 1}}));
}

TEST(LogModel, KnowsNoiseFromMotion) {
  const Task task = swinging_task();
  const prior::Prior prior = swinging_prior();
  Options options;
  options.rows = 150;
  const auto learned = [&](double push) {
    return learn_logs({swinging_log(1, 0, 0.002, push).episode}, task, prior, options, serial_evaluator());
  };
  EXPECT_TRUE(moves(learned(1)));
  EXPECT_FALSE(moves(learned(0)));
}

}  // namespace
}  // namespace rehearse::study
