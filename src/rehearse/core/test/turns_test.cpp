#include "rehearse/core/turns.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace rehearse {
namespace {

TEST(TurnCounter, CountsOnAnglesWithinOneTurnFromThatOfTheStart) {
  for (const double low : {-std::numbers::pi, 0.0}) {
    TurnCounter counter(-0.1);
    for (int episode = 0; episode < 2; ++episode) {
      counter.begin();
      for (int i = 0; i < 40; ++i) {
        const double angle = -0.1 + 0.7 * i;
        EXPECT_NEAR(counter.counted(angle - 2 * std::numbers::pi * std::floor((angle - low) / (2 * std::numbers::pi))),
                    angle, 1e-12);
      }
    }
  }
}

TEST(TurnCounter, LeavesAnglesAloneThatCountOnThemselves) {
  TurnCounter counter(0);
  for (const double angle : {6.4, 7.0, 12.0, 3.0, -3.5}) EXPECT_EQ(counter.counted(angle), angle);
}

TEST(TurnCounter, AChangeOfManyTurnsIsNone) {
  TurnCounter counter(0.5);
  EXPECT_EQ(counter.counted(0.5), 0.5);
  EXPECT_EQ(counter.counted(20.5), 20.5);
}

TEST(TurnCounter, TakesSinglePrecision) {
  TurnCounter counter(std::numbers::pi);
  EXPECT_GT(static_cast<float>(std::numbers::pi), std::numbers::pi);
  EXPECT_EQ(counter.counted(static_cast<float>(std::numbers::pi)), static_cast<float>(std::numbers::pi));
  EXPECT_NEAR(counter.counted(static_cast<float>(0.02 - std::numbers::pi)), std::numbers::pi + 0.02, 1e-6);
}

TEST(TurnCounter, AnAngleThatIsNotFiniteIsNoTurn) {
  TurnCounter counter(0);
  EXPECT_EQ(counter.counted(3), 3);
  EXPECT_TRUE(std::isnan(counter.counted(NAN)));
  EXPECT_EQ(counter.counted(-3), -3);
}

TEST(Turns, CountTheAnglesAloneAndThatOfTheTruthWithThem) {
  Turns turns({1}, Vector{{0, 3}});
  turns.begin();
  EXPECT_EQ(turns.counted(Vector{{3, 3}}), (Vector{{3, 3}}));
  const Vector measured = turns.counted(Vector{{-3, -3}});
  EXPECT_EQ(measured(0), -3);
  EXPECT_DOUBLE_EQ(measured(1), 2 * std::numbers::pi - 3);
  const Vector truth = turns.beside(Vector{{-3, -2.9}}, measured);
  EXPECT_EQ(truth(0), -3);
  EXPECT_DOUBLE_EQ(truth(1), 2 * std::numbers::pi - 2.9);
  EXPECT_EQ(turns.beside({}, measured).size(), 0) << "it is not known";
}

}  // namespace
}  // namespace rehearse
