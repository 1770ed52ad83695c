#include "rehearse/campaign/robot_of.hpp"

#include <filesystem>

#include "rehearse/files/regular_file.hpp"
#include "rehearse/files/toml_reader.hpp"

namespace rehearse::campaign {

experiment::Catalogue with_robot_of(const experiment::Catalogue& catalogue, std::string_view text,
                                    const std::string& source) {
  const std::string scenario = files::parse_toml(text, source)["scenario"].value_or(std::string());
  if (!scenario.ends_with(".toml")) return catalogue;
  const std::filesystem::path file = std::filesystem::path(source).parent_path() / scenario;
  return catalogue.with_robot(files::read_file(file, files::Links::follow), scenario, file.parent_path());
}

}  // namespace rehearse::campaign
