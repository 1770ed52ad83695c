#pragma once
// The robot of a file, as a run folder keeps it.

#include <filesystem>

#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::experiment {

/// Beside spec.toml: the file that describes the robot.
inline constexpr const char* kSpecFile = "spec.toml";
inline constexpr const char* kRobotFile = "robot.toml";
inline constexpr const char* kRobotFolder = "robot";  // with the files that it names

/// The folder with the files that a robot's file names: its own; of the robot.toml of a run folder, `robot` in it.
std::filesystem::path folder_of_files(const std::filesystem::path& robot_file);

/// The catalogue with the robot of a user's file. source: the file's name in messages. Throws InvalidInput.
Catalogue with_robot_of_file(const Catalogue& catalogue, const std::filesystem::path& file, const std::string& source);

/// The catalogue with the robot that a run folder keeps, if it keeps one. Throws InvalidInput where the catalogue has a
/// robot of another name: the functions of one would play the other.
Catalogue with_robot_of_run(const Catalogue& catalogue, const std::filesystem::path& folder);

/// Writes the file that describes the robot and those that it names.
void keep_robot(const RobotFile& robot, const std::filesystem::path& folder);

}  // namespace rehearse::experiment
