#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::scenario {

using Point = Eigen::Vector2d;  // m, x to the right and y up

struct Line {
  Point from, to;
};

/// How a robot looks in a plane, so that its motion can be shown: bodies that are straight from one point to another.
struct Drawing {
  struct Body {
    std::string name;
    double width_m = 0;
  };
  std::vector<Body> bodies;
  std::optional<Point> goal;  // where the end of the last body ought to be

  /// Where the bodies are in a state (dx), one line a body. Any thread.
  std::function<std::vector<Line>(const ConstVectorView& state)> lines;
};

}  // namespace rehearse::scenario
