#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Geometry>

#include "rehearse/core/types.hpp"

namespace rehearse::scenario {

using Point = Eigen::Vector2d;  // m, x to the right and y up

struct Line {
  Point from, to;
};

/// A drawing of a robot in a plane: bodies that are straight from one point to another.
struct LineDrawing {
  struct Body {
    std::string name;
    double width_m = 0;
  };
  std::vector<Body> bodies;
  std::optional<Point> goal;  // where the end of the last body ought to be

  /// The positions of the bodies in a state (dx), one line a body. Any thread.
  std::function<std::vector<Line>(const ConstVectorView& state)> lines;
};

struct Box {
  Eigen::Vector3d size_m;  // whole edges
};
struct Sphere {
  double radius_m = 0;
};
struct Capsule {
  double radius_m = 0;
  double length_m = 0;  // between the centres of its round ends, along the z of its frame
};

/// From the frame of a body, whose origin is the middle of its shape, to the world: m, z up.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // of norm 1
};

/// A drawing of a robot in space: rigid bodies. Views follow the first.
struct SolidDrawing {
  struct Body {
    std::string name;
    std::variant<Box, Sphere, Capsule> shape;
    bool foot = false;  // a sphere that walks on the floor: reports draw when it touches that
  };
  std::vector<Body> bodies;
  std::optional<double> floor_m;  // height of the floor
  double touching_m = 0.005;      // a foot that is nearer touches it

  /// The poses of the bodies in a state (dx), one a body. Any thread.
  std::function<std::vector<Pose>(const ConstVectorView& state)> poses;
};

using Drawing = std::variant<LineDrawing, SolidDrawing>;

}  // namespace rehearse::scenario
