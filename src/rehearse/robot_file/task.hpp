#pragma once

#include <optional>

#include "rehearse/files/toml_reader.hpp"
#include "rehearse/reward/saturating.hpp"
#include "rehearse/robot_file/robot.hpp"
#include "rehearse/scenario/drawing.hpp"

namespace rehearse::robot_file {

/// Compiles every formula of the robot and adds what is wrong with one, at its line.
void check_formulas(const Robot& robot, files::FileViolations& violations);

/// The task that a robot's formulas describe; they must be free of violations.
Task make_task(const Robot& robot);
std::optional<scenario::Drawing> make_drawing(const Robot& robot);

/// A squared distance as Σ_i d_i², with the closed form that moment matching needs where the d_i are sums of multiples
/// of features (states, sines and cosines of angles); empty where they are not.
std::optional<reward::ClosedForm> closed_form(const Robot& robot);

}  // namespace rehearse::robot_file
