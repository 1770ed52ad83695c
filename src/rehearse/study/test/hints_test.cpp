#include "rehearse/study/hints.hpp"

#include <gtest/gtest.h>

#include "rehearse/study/test/swings.hpp"

namespace rehearse::study {
namespace {

/// The log of a robot whose actions act so many steps after their rows.
Episode delayed_swing(std::uint64_t seed, Index delay) {
  Episode log = swinging_log(seed, 0).episode;
  Matrix sent = Matrix::Zero(log.steps(), 1);
  sent.topRows(log.steps() - delay) = log.actions.bottomRows(log.steps() - delay);
  log.actions = sent;
  return log;
}

std::vector<Hint> hints_of(const std::vector<Episode>& logs, const std::string& zeros = "") {
  Options options;
  options.zeros = zeros;
  return find_hints(logs, swinging_task(), swinging_prior(), options, serial_evaluator());
}

TEST(Hints, ThereIsNoneOfGoodLogs) {
  EXPECT_TRUE(hints_of({swinging_log(1, 0).episode, swinging_log(2, 0).episode}).empty());
  EXPECT_TRUE(hints_of({swinging_log(1, 0.1).episode, swinging_log(2, -0.1).episode}, "q").empty());
}

TEST(Hints, NameTheEncoderWithoutAZero) {
  const std::vector<Hint> hints = hints_of({swinging_log(1, 0.1).episode, swinging_log(2, -0.1).episode});
  ASSERT_FALSE(hints.empty());
  EXPECT_EQ(hints[0].states, std::vector<Index>{1});
  EXPECT_LT(hints[0].errors, 0.7);
  EXPECT_EQ(
      line_of({.states = {1, 0}, .errors = 0.5}, swinging_task()),
      "the zero of q and of dq seems to be off (zeros=q,dq of `identify`): short forecasts would have 0.50 times the "
      "errors");
}

TEST(Hints, NameTheDelay) {
  for (const Index delay : {4, 5, 6}) {  // with 4 and 6 steps, 3 are worse than 2
    const std::vector<Hint> hints = hints_of({delayed_swing(1, delay), delayed_swing(2, delay)});
    ASSERT_FALSE(hints.empty());
    EXPECT_TRUE(hints[0].states.empty());
    EXPECT_NEAR(hints[0].delay_s, 0.02 * static_cast<double>(delay), 0.021);
  }
  EXPECT_EQ(line_of({.delay_s = -0.06, .errors = 0.25}, swinging_task()),
            "actions seem to act 0.06 s earlier than their rows say (read.action_delay_s of `identify`): short "
            "forecasts would "
            "have 0.25 times the errors");
}

TEST(Hints, OfADelayNameWhatLearnersKnowItBy) {
  EXPECT_EQ(line_of({.delay_s = 0.06, .errors = 0.25}, swinging_task()),
            "actions seem to act 0.06 s later than their rows say (read.action_delay_s of `identify`; to learn, "
            "delay_s of the action): short forecasts would have 0.25 times the errors");
}

TEST(Hints, NameTheActionOfTheOtherSign) {
  std::vector<Episode> logs = {swinging_log(1, 0).episode, swinging_log(2, 0).episode};
  for (Episode& log : logs) log.actions *= -1;
  const std::vector<Hint> hints = hints_of(logs);
  ASSERT_FALSE(hints.empty());
  EXPECT_EQ(hints[0].negated, 0);
  EXPECT_LT(hints[0].errors, 0.5);
  EXPECT_EQ(line_of({.negated = 0, .errors = 0.1}, swinging_task()),
            "the action torque seems to have the other sign: short forecasts would have 0.10 times the errors");
}

TEST(Hints, RoundingHasNone) {
  const auto at_rest = [](double size) {
    std::vector<Episode> logs = {delayed_swing(1, 4), delayed_swing(2, 4)};
    for (Episode& log : logs) {
      log.states *= size;
      log.actions *= size;
    }
    return hints_of(logs);
  };
  EXPECT_FALSE(at_rest(1e-6).empty());
  EXPECT_TRUE(at_rest(1e-15).empty());
}

TEST(Hints, ShortLogsHaveNone) { EXPECT_TRUE(hints_of({swinging_log(1, 0.1).episode.part(0, 15)}).empty()); }

}  // namespace
}  // namespace rehearse::study
