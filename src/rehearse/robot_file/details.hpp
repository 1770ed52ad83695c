#pragma once

#include "rehearse/robot_file/robot.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::robot_file {

/// Lines of text about a scenario's reward, end, plant and priors, as the robot's file has them. plant: the values of
/// its parameters; noise: std of every measured state.
scenario::Details details_of(const Robot& robot, const std::vector<Parameter>& plant, const Vector& noise);

}  // namespace rehearse::robot_file
