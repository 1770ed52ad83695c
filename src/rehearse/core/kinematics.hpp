#pragma once

#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// Which state variables are rates of change of others.
struct Kinematics {
  struct Pair {
    Index position = 0, rate = 0;  // state variables
  };
  double dt_s = 0;  // control step
  std::vector<Pair> pairs;
};

}  // namespace rehearse
