#pragma once
// Files that a robot's file names, read once and kept with the robot. For the sources of this room.

#include <string>
#include <vector>

#include "rehearse/robot_file/table.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::robot_file {

class KeptFiles {
 public:
  KeptFiles(std::vector<scenario::NamedFile>& files, const scenario::ReadFile& read_file)
      : files_(files), read_file_(read_file) {}

  /// False: there is no such file in the folder of the robot's file.
  bool keep(const std::string& path);

  /// A violation where there is none.
  void require(Table& table, const std::string& key, const std::string& path);

  /// Takes `files`, a list of paths.
  void take_files(Table& table);

 private:
  std::vector<scenario::NamedFile>& files_;
  const scenario::ReadFile& read_file_;
};

}  // namespace rehearse::robot_file
