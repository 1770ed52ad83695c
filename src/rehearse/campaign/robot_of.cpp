#include "rehearse/campaign/robot_of.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/files/toml_reader.hpp"

namespace rehearse::campaign {

experiment::Catalogue with_robot_of(const experiment::Catalogue& catalogue, std::string_view text,
                                    const std::string& source) {
  const toml::table campaign = files::parse_toml(text, source);
  const std::string scenario = campaign["scenario"].value_or(std::string());
  if (!scenario.ends_with(".toml")) return catalogue;
  const std::filesystem::path file = std::filesystem::path(source).parent_path() / scenario;
  if (!std::filesystem::exists(file))
    throw InvalidInput(fmt::format("{}: line {}: scenario = '{}': there is no file {}", source,
                                   files::line_of(*campaign.get("scenario")), scenario, file.string()));
  return experiment::with_robot_of_file(catalogue, file, scenario);
}

}  // namespace rehearse::campaign
