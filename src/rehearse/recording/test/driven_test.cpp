#include "rehearse/recording/driven.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "swinging.hpp"

namespace rehearse::recording {
namespace {

/// A pendulum that swings with an amplitude.
Matrix swings(double amplitude) {
  Matrix states(41, 2);
  for (Index k = 0; k <= 40; ++k) {
    const double t = 3 * kStep_s * static_cast<double>(k);
    const double q = amplitude * std::sin(t);
    states.row(k) << q, 3 * amplitude * std::cos(t);
  }
  return states;
}

Episode measured(const Task& task, const Matrix& states) {
  return {.states = states, .true_states = states, .actions = Matrix::Zero(states.rows() - 1, task.action_size())};
}

std::vector<std::string> notes_on(const Matrix& states, const std::string& file = "trial.csv") {
  const Task task = swinging(StateKind::angle);
  return notes_on_driven(task, measured(task, states), file);
}

TEST(Driven, MotionOfARobotIsNotNoted) {
  for (const double amplitude : {0.0, 0.1, 4.0})
    EXPECT_EQ(notes_on(swings(amplitude)), std::vector<std::string>{}) << amplitude;
}

// Plants count turns on (system/counted_turns.hpp); of one that does not, models would learn the jumps.
TEST(Driven, AnAngleThatJumpsByATurnIsNoted) {
  Matrix states(401, 2);
  for (Index k = 0; k <= 400; ++k)
    states.row(k) << std::remainder(3 * kStep_s * static_cast<double>(k), 2 * std::numbers::pi), 3;
  const auto notes = notes_on(states);
  ASSERT_FALSE(notes.empty());
  EXPECT_TRUE(notes[0].starts_with("trial.csv: row 23: q jumps from 3 to ")) << notes[0];
}

TEST(Driven, AnAnswerThatIsWrongOnceIsNoted) {
  Matrix states = swings(0.1);
  states(15, 1) = 30;
  const auto notes = notes_on(states);
  ASSERT_FALSE(notes.empty());
  EXPECT_TRUE(notes[0].starts_with("trial.csv: row 17: dq jumps from ")) << notes[0];
}

TEST(Driven, APushIsNoJump) {
  Task task = swinging(StateKind::angle);
  task.actions = {{.name = "u", .bounds = {-3, 3}}};
  Matrix states = Matrix::Zero(41, 2);
  for (Index k = 11; k <= 40; ++k) states.row(k) << 0.05 * static_cast<double>(k - 10), 0.5;
  Episode pushed = measured(task, states);
  EXPECT_FALSE(notes_on_driven(task, pushed, "trial.csv").empty());
  pushed.actions(10, 0) = 3;
  for (const std::string& note : notes_on_driven(task, pushed, "trial.csv"))
    EXPECT_EQ(note.find("jumps"), std::string::npos) << note;
}

TEST(Driven, CommandsThatAnActuatorRemembersMayJump) {
  Task task = swinging(StateKind::angle);
  task.actions = {{.name = "u", .bounds = {-3, 3}, .actuation = {.delay_s = 2 * kStep_s}}};
  const Actuators actuators(task.actions, task.dt_s, 2);
  for (const StateVariable& remembered : actuators.variables()) task.states.push_back(remembered);
  Matrix states(41, task.state_size());
  states << swings(0.1), Matrix::Constant(41, actuators.memory(), 2.5);
  states.row(0).tail(actuators.memory()).setZero();
  EXPECT_EQ(notes_on_driven(task, measured(task, states), "trial.csv"), std::vector<std::string>{});
}

TEST(Driven, ASensorThatIsDeadIsNoted) {
  Matrix states = swings(0.1);
  states.col(0).setZero();
  EXPECT_EQ(notes_on(states, ""), std::vector<std::string>{"q is the same in all rows, while dq says that it changes"});
}

}  // namespace
}  // namespace rehearse::recording
