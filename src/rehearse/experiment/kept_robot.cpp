#include "rehearse/experiment/kept_robot.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment {

namespace fs = std::filesystem;

namespace {

/// False also where the folder itself cannot be read: who opens it says why.
bool is_there(const fs::path& file) {
  std::error_code none;
  return fs::exists(file, none);
}

void require_name_of_run(const std::string& given, const fs::path& folder) {
  const fs::path spec = folder / kSpecFile;
  if (!is_there(spec)) return;
  const std::string name = from_toml(files::read_file(spec), spec.string()).scenario;
  if (given != name)
    throw InvalidInput(
        fmt::format("{} is a run of the robot '{}', the one that is given is '{}'", folder.string(), name, given));
}

}  // namespace

fs::path folder_of_files(const fs::path& robot_file) {
  const fs::path folder = robot_file.parent_path();
  const bool is_kept =
      robot_file.filename() == kRobotFile && is_there(folder / kSpecFile) && is_there(folder / kRobotFolder);
  return is_kept ? folder / kRobotFolder : folder;
}

Catalogue with_robot_of_file(const Catalogue& catalogue, const fs::path& file, const std::string& source) {
  return catalogue.with_robot(files::read_file(file, files::Links::follow), source, folder_of_files(file));
}

Catalogue with_robot_of_run(const Catalogue& catalogue, const fs::path& folder) {
  for (const RobotFile& given : catalogue.robots) require_name_of_run(given.name, folder);
  const fs::path file = folder / kRobotFile;
  Catalogue of_run =
      is_there(file) ? catalogue.with_robot(files::read_file(file), file.string(), folder / kRobotFolder) : catalogue;
  of_run.of_run = true;
  return of_run;
}

void keep_robot(const RobotFile& robot, const fs::path& folder) {
  files::write_file(folder / kRobotFile, robot.text, files::Durability::power);
  for (const scenario::NamedFile& file : robot.files) {
    const fs::path path = folder / kRobotFolder / file.path;
    fs::create_directories(path.parent_path());
    files::write_file(path, file.bytes, files::Durability::power);
  }
}

}  // namespace rehearse::experiment
