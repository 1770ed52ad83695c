#pragma once
// A pendulum with an angle and its rate, for the tests of this room.

#include "rehearse/core/task.hpp"

namespace rehearse::recording {

inline constexpr double kStep_s = 0.05;

inline Task swinging(StateKind kind) {
  Task task;
  task.states = {{"q", "rad", kind, "dq"}, {"dq", "rad/s"}};
  task.dt_s = kStep_s;
  return task;
}

}  // namespace rehearse::recording
