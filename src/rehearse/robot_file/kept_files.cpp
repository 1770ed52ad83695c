#include "rehearse/robot_file/kept_files.hpp"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "rehearse/files/temporary_folder.hpp"

namespace rehearse::robot_file {

bool KeptFiles::keep(const std::string& path) {
  for (const scenario::NamedFile& file : files_)
    if (file.path == path) return true;
  if (!files::stays_within(path)) return false;
  std::optional<std::string> bytes = read_file_(path);
  if (!bytes) return false;
  files_.push_back({path, std::move(*bytes)});
  return true;
}

void KeptFiles::require(Table& table, const std::string& key, const std::string& path) {
  if (keep(path)) return;
  const bool may_be_a_folder = !std::filesystem::path(path).has_extension();
  const bool may_be_a_command = key == "program" && path.find(' ') != std::string::npos;
  table.wrong(key, fmt::format("'{}' is no file in the folder of the robot's file{}", path,
                               may_be_a_command  ? "; a command is a list: [\"python3\", \"robot.py\"]"
                               : may_be_a_folder ? "; of a folder, each file is named"
                                                 : ""));
}

void KeptFiles::take_files(Table& table) {
  std::vector<std::string> paths;
  table.reader().take("files", paths);
  for (const std::string& path : paths) require(table, "files", path);
}

}  // namespace rehearse::robot_file
