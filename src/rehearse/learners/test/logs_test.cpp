#include "rehearse/learners/logs.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::learners {
namespace {

Episode log_of(Index steps) {
  Episode log{.states = Vector::LinSpaced(steps + 1, 0, static_cast<double>(steps)),
              .actions = Matrix::Zero(steps, 1),
              .rewards = Vector::Zero(steps)};
  log.true_states = log.states;
  return log;
}

Task task(double dt_s) {
  Task task;
  task.states = {{"x", "m"}};
  task.actions = {{"u", "N", {-1, 1}}};
  task.dt_s = dt_s;
  return task;
}

TEST(Logs, OfOtherSizesAreRefused) {
  Logs logs;
  Episode wrong = log_of(100);
  wrong.actions.setZero(100, 2);
  EXPECT_THROW(logs.add({log_of(100), wrong}, task(0.1)), InvalidInput);
  EXPECT_EQ(logs.rows().size(), 0);
}

TEST(Logs, AreLearnedFromWhole) {
  Logs logs;
  EXPECT_EQ(logs.rows().size(), 0);
  logs.add({log_of(100), log_of(200)}, task(0.1));
  logs.add({log_of(Logs::kMost - 300)}, task(0.1));
  EXPECT_EQ(logs.rows().size(), Logs::kMost);
  EXPECT_EQ(logs.note(), "");
}

TEST(Logs, LongOnesAreLearnedFromInStretchesOfASecond) {
  Logs logs;
  logs.add({log_of(12000)}, task(0.02));
  const Matrix& states = logs.rows().states;
  EXPECT_EQ(states.rows(), 400);
  for (Index row = 0; row + 1 < states.rows(); ++row)
    EXPECT_EQ(states(row + 1, 0) - states(row, 0) == 1, row % 50 != 49) << row;
  EXPECT_EQ(states(0, 0), 0);
  EXPECT_EQ(states(399, 0), 11999);
  EXPECT_NE(logs.note().find("400 of the 12000 control steps"), std::string::npos) << logs.note();
}

TEST(Logs, ToldLaterAreSpreadWithThoseBefore) {
  Logs both, one_by_one;
  both.add({log_of(3000), log_of(1000)}, task(0.1));
  one_by_one.add({log_of(3000)}, task(0.1));
  one_by_one.add({log_of(1000)}, task(0.1));
  EXPECT_EQ(one_by_one.rows().states, both.rows().states) << "a run that is read again is told all at once";
}

}  // namespace
}  // namespace rehearse::learners
