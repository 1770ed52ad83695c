#pragma once
// [dynamics.NAME] of a robot's file that is a model of MuJoCo. For the sources of this room.

#include <map>
#include <string>
#include <vector>

#include "rehearse/robot_file/robot.hpp"
#include "rehearse/robot_file/table.hpp"

namespace rehearse::robot_file {

/// The model's part of a robot: its states and actions there. Wrong input becomes a violation.
ModelSource model_of(Table& table, const Robot& robot, files::FileViolations& violations);

/// The lines of states, actions and parameters, and of the keyframe, under the beginnings of what MuJoCo's room says of
/// them: "state 'q1'".
std::map<std::string, Index> lines_of_model(const toml::table& part, const ModelSource& model,
                                            const std::vector<std::string>& actions);

/// The parameter with what it `sets` and `scales`.
mujoco::ModelParameter moved_by(Table& entry, mujoco::ModelParameter parameter, files::FileViolations& violations);

}  // namespace rehearse::robot_file
