#include "rehearse/experiment/catalogue.hpp"

#include <algorithm>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/files/checksum.hpp"
#include "rehearse/files/regular_file.hpp"

namespace rehearse::experiment {
namespace {

/// The first line in which two texts differ, as each has it.
std::string first_difference(const std::string& text, const std::string& other) {
  std::istringstream of_text(text), of_other(other);
  std::string line, others;
  while (true) {
    const bool more = static_cast<bool>(std::getline(of_text, line));
    const bool more_there = static_cast<bool>(std::getline(of_other, others));
    if (!more) line.clear();
    if (!more_there) others.clear();
    if (line == others + "\r" || others == line + "\r") return "their lines end differently";
    if (line != others || !(more || more_there)) return fmt::format("`{}` in the one, `{}` in the other", line, others);
  }
}

}  // namespace

std::string checksum_of(const RobotFile& robot) {
  std::string bytes = robot.text;
  for (const scenario::NamedFile& file : robot.files)
    bytes += fmt::format("\n{} {}\n", file.path, file.bytes.size()) + file.bytes;
  return fmt::format("{:016x}", files::checksum(bytes));
}

scenario::ReadFile files_in(const std::filesystem::path& folder) {
  return [folder](const std::string& path) -> std::optional<std::string> {
    std::error_code none;  // a text may be too long for a path
    if (!std::filesystem::is_regular_file(folder / path, none)) return {};
    return files::read_file(folder / path, files::Links::follow);
  };
}

NamedScenario named(scenario::MakeBuilder make) {
  std::string name = make()->name();
  return {std::move(name), std::move(make)};
}

std::vector<std::unique_ptr<scenario::ScenarioBuilder>> Catalogue::scenario_builders() const {
  std::vector<std::unique_ptr<scenario::ScenarioBuilder>> builders;
  for (const NamedScenario& each : scenarios) builders.push_back(each.make());
  return builders;
}

std::vector<std::unique_ptr<learners::LearnerBuilder>> Catalogue::learner_builders() const {
  std::vector<std::unique_ptr<learners::LearnerBuilder>> builders;
  for (const auto& make_family : learner_families)
    for (auto& builder : make_family()) builders.push_back(std::move(builder));
  return builders;
}

std::unique_ptr<scenario::ScenarioBuilder> Catalogue::scenario(const std::string& name) const {
  const auto found = std::ranges::find(scenarios, name, &NamedScenario::name);
  return found == scenarios.end() ? nullptr : found->make();
}

std::unique_ptr<scenario::ScenarioBuilder> Catalogue::scenario_or_throw(const std::string& name) const {
  auto builder = scenario(name);
  if (!builder) throw InvalidInput(why_missing("scenario", name));
  return builder;
}

std::unique_ptr<learners::LearnerBuilder> Catalogue::learner(const std::string& name) const {
  for (auto& builder : learner_builders())
    if (builder->name() == name) return std::move(builder);
  return nullptr;
}

Catalogue Catalogue::with_robot(const std::string& text, const std::string& source,
                                const std::filesystem::path& folder) const {
  if (!read_robot) throw InvalidInput(fmt::format("{}: this program reads no robots from files", source));
  if (std::ranges::find(robots, text, &RobotFile::text) != robots.end()) return *this;
  const scenario::MakeBuilder make = read_robot(text, source, files_in(folder));
  const auto builder = make();
  const std::string name = builder->name();
  if (const RobotFile* same = robot(name))
    throw InvalidInput(fmt::format("{} and {} are two robots of one name, '{}': {}", source, same->source, name,
                                   first_difference(text, same->text)));
  if (std::ranges::find(scenarios, name, &NamedScenario::name) != scenarios.end())
    throw InvalidInput(fmt::format("{}: name = '{}' is that of another scenario", source, name));
  Catalogue with = *this;
  with.robots.push_back({name, source, text, builder->files()});
  with.scenarios.push_back({name, make});
  return with;
}

std::string Catalogue::scenario_name(const std::string& name_or_source) const {
  for (const RobotFile& each : robots)
    if (each.source == name_or_source) return each.name;
  return name_or_source;
}

const RobotFile* Catalogue::robot(const std::string& scenario) const {
  for (const RobotFile& each : robots)
    if (each.name == scenario) return &each;
  return nullptr;
}

const NotBuilt* Catalogue::left_out(const std::string& name) const {
  const auto found = std::ranges::find(not_built, name, &NotBuilt::name);
  return found == not_built.end() ? nullptr : &*found;
}

std::string Catalogue::why_missing(const std::string& kind, const std::string& name) const {
  if (const NotBuilt* missing = left_out(name))
    return fmt::format("{} '{}' is not built: {}", kind, name, missing->reason);
  std::vector<std::string> known;
  if (kind == "scenario")
    for (const NamedScenario& each : scenarios) known.push_back(each.name);
  else
    for (const auto& builder : learner_builders()) known.push_back(builder->name());
  if (name.empty()) return fmt::format("no {} is named (known: {})", kind, fmt::join(known, ", "));
  return unknown_name(kind, name, known) +
         (of_run ? fmt::format("; a {} in C++ is known only to the program that began the run",
                               kind == "scenario" ? "robot" : kind)
                 : "");
}

std::string Catalogue::why_no_start(const std::string& learner) const {
  std::vector<std::string> able;
  for (const auto& builder : learner_builders())
    if (builder->takes_start()) able.push_back(builder->name());
  const std::string others = able.empty() ? "" : fmt::format("; those that can: {}", fmt::join(able, ", "));
  return fmt::format("learner {} cannot begin with a policy{}", learner, others);
}

std::string unknown_name(const std::string& kind, const std::string& name, const std::vector<std::string>& known) {
  if (known.empty()) return fmt::format("unknown {} '{}': there are none", kind, name);
  return fmt::format("unknown {} '{}'{}", kind, name, suggestions(name, known));
}

}  // namespace rehearse::experiment
