#include "apps/reference/words.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/options.hpp"
#include "rehearse/experiment/preset.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::apps {
namespace {

std::vector<std::string> keys_of(const Fields& fields) {
  std::vector<std::string> keys;
  for (const Field& field : describe_fields(fields))
    if (!field.expert) keys.push_back(field.name);
  return keys;
}

template <class Builder>
std::vector<std::string> keys_of(Builder& builder) {
  return keys_of(Fields([&](FieldVisitor& v) { builder.fields(v); }));
}

void add_any(WordsFor& words) {
  std::set<std::string> all;
  for (const auto& [name, those] : words) all.insert(those.begin(), those.end());
  words["any"].assign(all.begin(), all.end());
}

/// Files by their ending, "FILE.html", "ROBOT.toml".
Expected files_like(const std::string& value) {
  const std::size_t dot = value.find('.');
  return {.files = true, .ending = dot == std::string::npos ? "" : value.substr(dot)};
}

}  // namespace

Vocabulary vocabulary(const experiment::Catalogue& catalogue) {
  Vocabulary all;
  for (const auto& builder : catalogue.scenario_builders()) {
    all.scenarios.push_back({builder->name(), builder->summary()});
    std::vector<std::string>& priors = all.priors[builder->name()] = builder->prior_names();
    if (builder->build().oracle) priors.push_back(scenario::kOracle);
    all.keys[builder->name()] = keys_of(*builder);
  }
  for (const auto& builder : catalogue.learner_builders()) {
    all.learners.push_back({builder->name(), builder->summary()});
    all.keys[builder->name()] = keys_of(*builder);
  }
  for (const auto& preset : catalogue.presets)
    all.presets.push_back({preset.name, experiment::Preset(preset.text, preset.name).title()});
  add_any(all.priors);
  add_any(all.keys);
  experiment::Spec spec;
  all.keys["runs"] = keys_of(Fields([&](FieldVisitor& v) { spec.settable_fields(v); }));
  return all;
}

Expected expected(const std::string& command, const ReferenceOption& option) {
  static const std::set<std::string> kFree = {"", "N", "M", "K", "S", "K/N", "REASON"};
  if (kFree.contains(option.value)) return {};
  if (option.value == "DIR") return {.folders = true};
  if (option.name == "SCENARIO" || option.name == "ROBOT")
    return {.names = {Names::scenarios}, .files = true, .ending = ".toml"};
  if (option.name == "FILE" && command == "campaign") return {.files = true, .ending = ".toml"};
  if (option.value.starts_with("FILE") || option.value.starts_with("LOG.") || option.value == "ROBOT.toml")
    return files_like(option.value);
  if (option.name == "NAME" && command == "list")
    return {.names = {Names::scenarios, Names::learners}, .files = true, .ending = ".toml"};
  if (option.name == "NAME" && command == "new") return {};
  if (option.name == "--learner") return {.names = {Names::learners}};
  if (option.name == "--prior") return {.names = {Names::priors}};
  if (option.name == "--preset") return {.names = {Names::presets}, .files = true, .ending = ".toml"};
  if (option.name == "--set") return {.names = {Names::keys}};
  throw std::logic_error(fmt::format("apps/reference/words.cpp does not know what completes {} {} of {}", option.name,
                                     option.value, command));
}

std::string option_names(const ReferenceCommand& command, bool with_value) {
  std::vector<std::string> names;
  for (const ReferenceOption& option : command.options)
    if (option.value.empty() != with_value) names.push_back(option.name);
  return fmt::format("{}", fmt::join(names, " "));
}

std::string names_of(const std::vector<NamedThing>& things) {
  std::vector<std::string> names;
  names.reserve(things.size());
  for (const NamedThing& thing : things) names.push_back(thing.name);
  return fmt::format("{}", fmt::join(names, " "));
}

std::string case_function(const std::string& function, const WordsFor& words) {
  std::string text = "\n" + function + "() {\n  case $1 in\n";
  for (const auto& [name, those] : words) text += fmt::format("    {}) echo {} ;;\n", name, fmt::join(those, " "));
  return text + "  esac\n}\n";
}

std::string single_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace rehearse::apps
