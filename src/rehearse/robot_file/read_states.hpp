#pragma once
// [[state]] of a robot's file. For the sources of this room.

#include <vector>

#include "rehearse/robot_file/robot.hpp"
#include "rehearse/robot_file/table.hpp"

namespace rehearse::robot_file {

/// The states, none where there is no table of one. names: what formulas may use; gets those of the states. Wrong input
/// becomes a violation.
std::vector<State> read_states(Table& file, expression::Formulas& names, files::FileViolations& violations);

}  // namespace rehearse::robot_file
