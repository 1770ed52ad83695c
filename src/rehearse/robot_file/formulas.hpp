#pragma once

#include <cstdint>
#include <vector>

#include "rehearse/expression/program.hpp"
#include "rehearse/robot_file/robot.hpp"

namespace rehearse::robot_file {

/// Why other formulas do not know the actions before and the time.
inline constexpr const char* kOnlyOfCosts =
    "is known to the `cost` of [reward], which is subtracted from it, and to the `keep` of a [[limit]] alone";

enum class Of : std::uint8_t {
  states,
  steps,  // of states and actions
  costs   // costs and limits: of actions one step before, and of the time since the start, too
};

/// The inputs of formulas, in that order. Names that others know are explained.
expression::Formulas inputs_of(const Robot& robot, Of of);

/// The same with the robot's definitions. A definition may use what the formula that uses it may.
expression::Formulas formulas_of(const Robot& robot, Of of);

/// True of a name that a state, an action or a definition has: it hides an action before, or the time.
bool is_own_name(const Robot& robot, const std::string& name);

expression::Program program(expression::Formulas of, const std::vector<Formula>& outputs);

/// The formulas (rows × outputs) of states and actions; columns of X, then of U, are the program's inputs. Nothing is
/// allocated but what a thread keeps.
void evaluate(const expression::Program& program, const ConstMatrixView& X, const ConstMatrixView& U,
              MatrixView results);
Matrix evaluate(const expression::Program& program, const ConstMatrixView& X, const ConstMatrixView& U = Matrix());

/// The same of one formula.
void evaluate_one(const expression::Program& program, const ConstMatrixView& X, const ConstMatrixView& U,
                  VectorView values);

}  // namespace rehearse::robot_file
