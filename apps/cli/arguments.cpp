#include "apps/cli/arguments.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "apps/cli/output_file.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/kept_robot.hpp"

namespace rehearse::apps {

void set_text(const Fields& fields, const std::string& name, const std::optional<std::string>& text,
              Violations& violations) {
  if (!text) return;
  try {
    set_field(fields, name, *text);
  } catch (const InvalidInput& error) {
    violations.add(fmt::format("--{}", error.what()));
  }
}

std::optional<Index> trial_of(const std::optional<std::string>& text, Violations& violations) {
  Index trial = 0;
  set_text([&](FieldVisitor& v) { v.integer("trial", trial, "which trial, from 1", at_least(1)); }, "trial", text,
           violations);
  return text ? std::optional<Index>(trial) : std::nullopt;
}

void require_page(const std::optional<std::string>& out, Violations& violations) {
  if (out) violations.attempt([&] { check_output(page_file(*out, "--out FILE.html")); });
}

void refuse_file_without_ending(const experiment::Catalogue& catalogue, const std::string& robot) {
  std::error_code none;
  if (robot.empty() || robot.ends_with(".toml") || catalogue.scenario(robot)) return;
  if (std::filesystem::is_regular_file(robot + ".toml", none))
    throw InvalidInput(fmt::format("there is no scenario '{0}'; the file is {0}.toml", robot));
  if (std::filesystem::is_regular_file(robot, none))
    throw InvalidInput(fmt::format("there is no scenario '{}'; the name of a robot's file ends in .toml", robot));
}

experiment::Catalogue with_robot(const experiment::Catalogue& built_in, const std::string& robot) {
  if (!robot.ends_with(".toml")) {
    refuse_file_without_ending(built_in, robot);
    return built_in;
  }
  return experiment::with_robot_of_file(built_in, robot, robot);
}

std::vector<std::pair<std::string, std::string>> settings_of(const std::vector<std::string>& set,
                                                             Violations& violations) {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const std::string& setting : set) {
    const std::size_t equals = setting.find('=');
    if (equals == 0 || equals == std::string::npos)
      violations.add(fmt::format("--set {}: must be KEY=VALUE", setting));
    else
      settings.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
  return settings;
}

Index threads_of(const std::optional<std::string>& text, Violations& violations) {
  Index threads = 0;
  set_text([&](FieldVisitor& v) { v.integer("threads", threads, "threads to compute with", between(1, 1024)); },
           "threads", text, violations);
  return threads;
}

}  // namespace rehearse::apps
