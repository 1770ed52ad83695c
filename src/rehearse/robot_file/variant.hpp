#pragma once
// [plant] and [prior.NAME] of a robot's file. For the sources of this room.

#include <string>
#include <vector>

#include "rehearse/robot_file/table.hpp"

namespace rehearse::robot_file {

/// The dynamics that a part names, with the values that it gives to parameters. Wrong input becomes a violation.
Variant read_variant(const std::string& name, Table& table, const std::vector<Dynamics>& dynamics,
                     files::FileViolations& violations);

/// Makes the parameters that the part tunes tunable: tune.NAME = [low, high] or { choices = […] }.
void tune(Table& table, Variant& variant, const std::vector<Dynamics>& dynamics, files::FileViolations& violations);

/// False, and a violation, if the node is no number.
bool take_number(const std::string& name, const toml::node& node, double& value, files::FileViolations& violations);

}  // namespace rehearse::robot_file
