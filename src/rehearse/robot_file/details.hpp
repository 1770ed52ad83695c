#pragma once

#include "rehearse/robot_file/robot.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::robot_file {

/// What the functions of a robot's scenario do, as its file says it. plant: the values of its parameters; noise: std of
/// every measured state.
scenario::Details details_of(const Robot& robot, const std::vector<Parameter>& plant, const Vector& noise);

}  // namespace rehearse::robot_file
