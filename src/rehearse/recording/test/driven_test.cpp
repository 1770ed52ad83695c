#include "rehearse/recording/driven.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "swinging.hpp"

namespace rehearse::recording {
namespace {

/// A pendulum that swings with an amplitude, as a robot whose encoder has one turn measures it.
Matrix swings(double amplitude) {
  Matrix states(41, 2);
  for (Index k = 0; k <= 40; ++k) {
    const double t = 3 * kStep_s * static_cast<double>(k);
    const double q = amplitude * std::sin(t);
    states.row(k) << std::remainder(q, 2 * std::numbers::pi), 3 * amplitude * std::cos(t);
  }
  return states;
}

TEST(Driven, MotionOfARobotIsNotNoted) {
  for (const double amplitude : {0.0, 0.1, 4.0})
    EXPECT_EQ(notes_on_driven(swinging(StateKind::angle), swings(amplitude), "trial.csv"), std::vector<std::string>{})
        << amplitude;
}

TEST(Driven, AWheelThatIsMeasuredWithinOneTurnIsNotNoted) {
  Matrix states(401, 2);
  for (Index k = 0; k <= 400; ++k)
    states.row(k) << std::remainder(3 * kStep_s * static_cast<double>(k), 2 * std::numbers::pi), 3;
  EXPECT_EQ(notes_on_driven(swinging(StateKind::angle), states, "trial.csv"), std::vector<std::string>{});
}

TEST(Driven, AnAnswerThatIsWrongOnceIsNoted) {
  Matrix states = swings(0.1);
  states(15, 1) = 30;
  const auto notes = notes_on_driven(swinging(StateKind::angle), states, "trial.csv");
  ASSERT_FALSE(notes.empty());
  EXPECT_TRUE(notes[0].starts_with("trial.csv: row 17: dq jumps from ")) << notes[0];
}

TEST(Driven, ASensorThatIsDeadIsNoted) {
  Matrix states = swings(0.1);
  states.col(0).setZero();
  EXPECT_EQ(notes_on_driven(swinging(StateKind::angle), states, ""),
            std::vector<std::string>{"q is the same in all rows, while dq says that it changes"});
}

}  // namespace
}  // namespace rehearse::recording
