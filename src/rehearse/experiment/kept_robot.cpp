#include "rehearse/experiment/kept_robot.hpp"

#include "rehearse/files/write.hpp"

namespace rehearse::experiment {

namespace fs = std::filesystem;

Catalogue with_robot_of_run(const Catalogue& catalogue, const fs::path& folder) {
  const fs::path file = folder / kRobotFile;
  Catalogue of_run =
      fs::exists(file) ? catalogue.with_robot(files::read_file(file), file.string(), folder / kRobotFolder) : catalogue;
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
