#pragma once
// [dynamics.NAME] of a robot's file. For the sources of this room.

#include "rehearse/robot_file/robot.hpp"
#include "rehearse/robot_file/table.hpp"

namespace rehearse::robot_file {

/// Adds the dynamics to the robot, whose states are known, and the files that they name. Wrong input becomes a
/// violation.
void read_dynamics(Table& file, Robot& robot, const scenario::ReadFile& read_file, files::FileViolations& violations);

}  // namespace rehearse::robot_file
