#pragma once

#include <functional>
#include <optional>
#include <string>

namespace rehearse::robot_file {

/// The bytes of a file by its path from the robot's file; empty: there is none.
using ReadFile = std::function<std::optional<std::string>(const std::string& path)>;

}  // namespace rehearse::robot_file
