#pragma once

#include <cstdint>
#include <vector>

#include "rehearse/expression/program.hpp"
#include "rehearse/robot_file/robot.hpp"

namespace rehearse::robot_file {

/// Why other formulas do not know the actions before and the time.
inline constexpr const char* kOnlyOfCosts =
    "is known to the `cost` of [reward], which is subtracted from it, and to the `keep` of a [[limit]] alone";

enum class Of : std::uint8_t { states, steps };

/// The inputs of formulas: states, and behind them the actions of a step. Names that others know are explained.
expression::Formulas inputs_of(const Robot& robot, Of of);

/// The same with the robot's definitions.
expression::Formulas formulas_of(const Robot& robot, Of of);

/// Formulas of costs and limits. Their further inputs are the actions one step before, and the time since the start.
expression::Formulas formulas_of_costs(const Robot& robot);

expression::Program program(expression::Formulas of, const std::vector<Formula>& outputs);

/// The formulas (rows × outputs) of states and actions; columns of X, then of U, are the program's inputs.
Matrix evaluate(const expression::Program& program, const ConstMatrixView& X, const ConstMatrixView& U = Matrix());

}  // namespace rehearse::robot_file
