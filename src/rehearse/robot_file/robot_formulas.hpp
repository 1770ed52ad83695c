#pragma once
// Formulas of a robot's task, for the sources of this room.

#include <cstdint>
#include <vector>

#include "rehearse/expression/program.hpp"
#include "rehearse/robot_file/robot.hpp"

namespace rehearse::robot_file {

inline constexpr const char* kOnlyOfCosts = "is known to the `cost` of [reward] alone";

enum class Of : std::uint8_t { states, steps };

/// The inputs of formulas: states, and behind them the actions of a step. Names that others know are explained.
expression::Formulas inputs_of(const Robot& robot, Of of);

/// The same with the robot's definitions.
expression::Formulas formulas_of(const Robot& robot, Of of);

expression::Program program(expression::Formulas of, const std::vector<Formula>& outputs);

/// The formulas (rows × outputs) of states and actions; columns of X, then of U, are the program's inputs.
Matrix evaluate(const expression::Program& program, const ConstMatrixView& X, const ConstMatrixView& U = Matrix());

}  // namespace rehearse::robot_file
