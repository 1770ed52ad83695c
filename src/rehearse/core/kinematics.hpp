#pragma once

#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// The state variables that are rates of change of others, and those moved by servos.
struct Kinematics {
  struct Pair {
    Index position = 0, rate = 0;  // state variables
  };
  struct Servo {
    Index action = 0, position = 0;  // the action is the target of the position
    Index rate = -1;                 // of the position, −1: no state is
    Index type = 0;                  // servos of the same type are alike
  };
  double dt_s = 0;          // control step
  std::vector<Pair> pairs;  // a position stands before its rate, where that is a position, too
  std::vector<Servo> servos;
};

}  // namespace rehearse
