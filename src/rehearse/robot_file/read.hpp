#pragma once

#include <string>
#include <string_view>

#include "rehearse/robot_file/robot.hpp"

namespace rehearse::robot_file {

/// Reads a robot's file (docs/own-robot.md), and the files that it names. functions: those of the program. Throws
/// InvalidInput with a line for everything that is wrong, "SOURCE: line N: …".
Robot read(std::string_view text, const std::string& source, const scenario::ReadFile& read_file,
           const Functions& functions = {});

}  // namespace rehearse::robot_file
