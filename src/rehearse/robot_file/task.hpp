#pragma once

#include <optional>

#include "rehearse/files/toml_reader.hpp"
#include "rehearse/robot_file/robot.hpp"
#include "rehearse/scenario/drawing.hpp"

namespace rehearse::robot_file {

/// Compiles every formula of the robot and adds what is wrong with one, at its line.
void check_formulas(const Robot& robot, files::FileViolations& violations);

/// The task that a robot's formulas describe; they must be free of violations.
Task make_task(const Robot& robot);
std::optional<scenario::Drawing> make_drawing(const Robot& robot);

}  // namespace rehearse::robot_file
