#pragma once
// The values of a robot's formulas where its episodes start. For the sources of this room.

#include "rehearse/core/task.hpp"
#include "rehearse/files/toml_reader.hpp"
#include "rehearse/robot_file/robot.hpp"

namespace rehearse::robot_file {

/// A violation for every formula that has no finite value at the mean start under actions in the middle of their
/// bounds, and for `ended` where it holds there. Rates have the parameters of the plant and of each prior. Programs,
/// models and functions are not asked. The formulas compile; the task is the robot's.
void check_start(const Robot& robot, const Task& task, files::FileViolations& violations);

}  // namespace rehearse::robot_file
