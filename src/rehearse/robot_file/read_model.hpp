#pragma once
// [dynamics.NAME] of a robot's file that is a model of MuJoCo. For the sources of this room.

#include "rehearse/robot_file/robot.hpp"
#include "rehearse/robot_file/table.hpp"

namespace rehearse::robot_file {

/// The model's part of a robot: its states and actions there. Wrong input becomes a violation.
ModelSource model_of(Table& table, const Robot& robot, files::FileViolations& violations);

/// The parameter with what it `sets` and `scales`.
mujoco::ModelParameter moved_by(Table& entry, mujoco::ModelParameter parameter, files::FileViolations& violations);

}  // namespace rehearse::robot_file
