#include "rehearse/robot_file/functions.hpp"

#include <fmt/format.h>

namespace rehearse::robot_file {

std::string missing_function(const std::string& name) {
  return fmt::format(
      "'{}' is a function of the program that wrote this file, and this one has none of that name "
      "(in Python the robot is given again: rehearse.resume(folder, robot))",
      name);
}

}  // namespace rehearse::robot_file
