#include "rehearse/robot_file/functions.hpp"

#include <fmt/format.h>

namespace rehearse::robot_file {

std::string missing_function(const std::string& name) {
  return fmt::format(
      "'{}' is a function of the program that wrote this file, and no file keeps functions: in Python the robot is "
      "given again, rehearse.open_run(folder, robot)",
      name);
}

}  // namespace rehearse::robot_file
