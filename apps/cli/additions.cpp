#include "apps/cli/additions.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"

namespace rehearse::apps {
namespace {

/// Adds a name to those that are taken, unless it is wrong.
void take(const std::string& kind, const std::string& name, std::vector<std::string>& taken, Violations& violations) {
  violations.require(is_word(name), fmt::format("{} '{}': its name must be of letters, digits, - and _", kind, name));
  violations.require(!is_among(name, taken),
                     fmt::format("{} '{}': its name must be its own, but another {} has it", kind, name, kind));
  taken.push_back(name);
}

void add_robots(experiment::Catalogue& catalogue, const std::vector<RobotMaker>& robots, Violations& violations) {
  std::vector<std::string> taken;
  for (const experiment::NamedScenario& each : catalogue.scenarios) taken.push_back(each.name);
  for (const RobotMaker& make : robots) {
    const auto builder = make ? make() : nullptr;
    violations.require(builder != nullptr, "a robot is null, must be made by a function");
    if (!builder) continue;
    take("scenario", builder->name(), taken, violations);
    catalogue.scenarios.push_back({builder->name(), make});
  }
}

void add_learners(experiment::Catalogue& catalogue, const std::vector<LearnerFamily>& families,
                  Violations& violations) {
  std::vector<std::string> taken;
  for (const auto& builder : catalogue.learner_builders()) taken.push_back(builder->name());
  for (const LearnerFamily& make : families) {
    violations.require(make != nullptr, "a family of learners is null, must be made by a function");
    if (!make) continue;
    for (const auto& builder : make()) take("learner", builder->name(), taken, violations);
    catalogue.learner_families.push_back(make);
  }
}

}  // namespace

experiment::Catalogue with_additions(experiment::Catalogue catalogue, const std::vector<RobotMaker>& robots,
                                     const std::vector<LearnerFamily>& learners) {
  Violations violations;
  if (!robots.empty()) add_robots(catalogue, robots, violations);
  if (!learners.empty()) add_learners(catalogue, learners, violations);
  violations.throw_if_any();
  return catalogue;
}

}  // namespace rehearse::apps
