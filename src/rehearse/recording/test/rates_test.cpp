#include "rehearse/recording/rates.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"
#include "swinging.hpp"

namespace rehearse::recording {
namespace {

/// The notes on states q = sin(5 t) whose rate is wrong by a factor and by noise.
std::vector<std::string> notes(double factor, double noise = 0, Index steps = 60) {
  Rng rng({.seed = 5});
  Matrix states(steps + 1, 2);
  for (Index k = 0; k <= steps; ++k) {
    const double t = kStep_s * static_cast<double>(k);
    states.row(k) << std::sin(5 * t), factor * 5 * std::cos(5 * t) + noise * rng.normal();
  }
  return notes_on_rates(swinging(StateKind::plain), states.topRows(steps), states.bottomRows(steps));
}

TEST(Rates, OtherUnitsAndSignsAreNoted) {
  for (const double right : {1.0, 0.8, 1.3}) EXPECT_EQ(notes(right).size(), 0U) << right;
  for (const double wrong : {2.0, 0.5, 1.5, 180 / std::numbers::pi, -1.0}) EXPECT_EQ(notes(wrong).size(), 1U) << wrong;
  EXPECT_EQ(notes(-1)[0].find("q changes -1.01 times as fast as dq says"), 0U) << notes(-1)[0];
}

TEST(Rates, ColumnsThatAreNoMeasurementOrAnotherOneAreNoted) {
  Rng rng({.seed = 7});
  constexpr Index kSteps = 240;
  Matrix states(kSteps + 1, 2);
  for (Index k = 0; k <= kSteps; ++k) {
    const double t = kStep_s * static_cast<double>(k);
    states.row(k) << std::sin(2 * t) + 1e-3 * rng.normal(), 2 * std::cos(2 * t) + 1e-2 * rng.normal();
  }
  const auto note = [&](const Matrix& of) {
    const auto notes = notes_on_rates(swinging(StateKind::plain), of.topRows(kSteps), of.bottomRows(kSteps));
    return notes.empty() ? "" : notes.front();
  };
  EXPECT_EQ(note(states), "");
  Matrix wrong = states;
  wrong.col(0).setConstant(0.3);
  EXPECT_EQ(note(wrong), "q is the same in all rows, while dq says that it changes");
  wrong = states;
  wrong.col(1).setZero();
  EXPECT_EQ(note(wrong), "dq is 0 in all rows, while q changes");
  wrong = states;
  wrong.col(0).tail(100).setConstant(states(140, 0));
  EXPECT_EQ(note(wrong).find("q stands still for "), 0U) << note(wrong);
  wrong = states;
  for (Index k = 0; k <= kSteps; ++k) wrong(k, 1) = std::sin(3.3 * kStep_s * static_cast<double>(k));
  EXPECT_EQ(note(wrong), "q does not change as dq says, by no factor: is one of the columns another quantity?");
}

TEST(Rates, NoiseAtRestAndSlowSensorsAreNotNoted) {
  Rng rng({.seed = 8});
  Matrix rest(401, 2), slow(401, 2);
  for (Index k = 0; k <= 400; ++k) {
    const double t = kStep_s * static_cast<double>(k - k % 20);
    rest.row(k) << 0.1 * rng.normal(), 3 * rng.normal();
    slow.row(k) << std::sin(0.5 * t), 0.5 * std::cos(0.5 * kStep_s * static_cast<double>(k));
  }
  for (const Matrix& states : {rest, slow})
    EXPECT_EQ(notes_on_rates(swinging(StateKind::plain), states.topRows(400), states.bottomRows(400)),
              std::vector<std::string>{});
}

/// How late the rate of q = sin(5 t) seems to be, that is the mean of the last `differences` of readings (0: it is
/// exact), where q is read in steps of `counts` and with noise.
double lateness(Index differences, double counts = 0, double noise = 0) {
  constexpr Index kRows = 200;
  Rng rng({.seed = 6});
  Vector times(kRows), q(kRows), rate(kRows);
  for (Index k = 0; k < kRows; ++k) {
    times(k) = kStep_s * static_cast<double>(k);
    q(k) = std::sin(5 * times(k)) + noise * rng.normal();
    if (counts > 0) q(k) = counts * std::round(q(k) / counts);
    rate(k) = differences == 0  ? 5 * std::cos(5 * times(k)) + 5 * noise * rng.normal()
              : k < differences ? 5
                                : (q(k) - q(k - differences)) / (static_cast<double>(differences) * kStep_s);
  }
  return lateness_s(times, q, rate);
}

TEST(Rates, ThatAreDifferencesOfReadingsAreLate) {
  EXPECT_NEAR(lateness(1), 0.5 * kStep_s, 1e-12);
  EXPECT_NEAR(lateness(2), kStep_s, 1e-12);
  EXPECT_NEAR(lateness(3), 1.5 * kStep_s, 1e-12);
  EXPECT_NEAR(lateness(2, 0.01), kStep_s, 1e-12);
  EXPECT_EQ(lateness(0), 0) << "it is exact";
  EXPECT_EQ(lateness(0, 0.01), 0);
  EXPECT_EQ(lateness(0, 0, 0.05), 0) << "noise says nothing";
}

TEST(Rates, ThatAreNoisyAreNotContradicted) { EXPECT_EQ(notes(1, 4, 400).size(), 0U); }

TEST(Rates, NothingIsSaidOfARobotAtRest) {
  const Matrix still = Matrix::Zero(10, 2);
  EXPECT_EQ(notes_on_rates(swinging(StateKind::plain), still, still).size(), 0U);
  EXPECT_EQ(notes_on_rates(swinging(StateKind::plain), still.topRows(0), still.topRows(0)).size(), 0U)
      << "nor of no step";
  Matrix rounding = still;
  rounding.col(1).setConstant(1e-15);
  EXPECT_EQ(notes_on_rates(swinging(StateKind::plain), rounding, rounding).size(), 0U);
}

}  // namespace
}  // namespace rehearse::recording
