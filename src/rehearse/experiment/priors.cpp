#include "rehearse/experiment/priors.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/options.hpp"

namespace rehearse::experiment {
namespace {

scenario::NamedPrior oracle_prior(const scenario::Scenario& scenario) {
  const ParameterSpace& space = scenario.oracle->parameters();
  return {scenario::kOracle, scenario.oracle, space.fixed_at(space.values())};
}

std::vector<std::string> known_names(const scenario::Scenario& scenario) {
  std::vector<std::string> names;
  for (const scenario::NamedPrior& prior : scenario.priors) names.push_back(prior.name);
  if (scenario.oracle) names.push_back(scenario::kOracle);
  return names;
}

std::string unknown_prior(const scenario::Scenario& scenario, const std::string& name) {
  const std::vector<std::string> known = known_names(scenario);
  if (name == scenario::kOracle)
    return fmt::format("scenario {} has no oracle: it has no plant, or none that is a simulator for a prior{}",
                       scenario.name, suggestions(name, known));
  if (known.empty()) return fmt::format("unknown prior '{}': scenario {} has no priors", name, scenario.name);
  return fmt::format("unknown prior '{}' of scenario {}{}", name, scenario.name, suggestions(name, known));
}

const scenario::NamedPrior* find_prior(const std::vector<scenario::NamedPrior>& priors, const std::string& name) {
  const auto found = std::find_if(priors.begin(), priors.end(), [&](const auto& p) { return p.name == name; });
  return found == priors.end() ? nullptr : &*found;
}

void set_value(scenario::NamedPrior& prior, const std::string& parameter, double value, Violations& violations) {
  if (prior.name == scenario::kOracle) {
    violations.add(fmt::format("prior.{0}: the oracle is the plant's own dynamics, set plant.{0} instead", parameter));
    return;
  }
  try {
    prior.parameters.set_value(parameter, value);
  } catch (const InvalidInput& error) {
    violations.add(fmt::format("prior {}: {}", prior.name, error.what()));
  }
}

}  // namespace

std::string unknown_option(const std::string& key, const std::vector<std::string>& known, const std::string& of) {
  const std::string meant = did_you_mean(key, known);
  return fmt::format("unknown option '{}'{}", key,
                     meant.empty() ? fmt::format(": `list` of {} names all, in Python `rehearse.options`", of) : meant);
}

std::string without_prior(const std::string& key, const std::string& prior) {
  const std::string prefix = fmt::format("prior.{}.", prior);
  return key.starts_with(prefix) ? "prior." + key.substr(prefix.size()) : key;
}

std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names;
  if (text.empty()) return names;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(',', begin);
    names.push_back(text.substr(begin, end - begin));
  }
  return names;
}

std::string phi_text(const std::string& names, std::size_t i, double value) {
  const std::vector<std::string> priors = split_names(names);
  const bool is_choice = i == 0 && priors.size() > 1 && value >= 0 && value < static_cast<double>(priors.size());
  return is_choice ? priors[static_cast<std::size_t>(value)] : fmt::format("{:.4g}", value);
}

ChosenPriors::ChosenPriors(const scenario::Scenario& scenario, const std::vector<std::string>& names,
                           Violations& violations) {
  for (const std::string& name : names) {
    if (find_prior(priors_, name)) {
      violations.add(fmt::format("prior '{}' is named twice", name));
    } else if (const scenario::NamedPrior* found = find_prior(scenario.priors, name)) {
      priors_.push_back(*found);
    } else if (name == scenario::kOracle && scenario.oracle) {
      priors_.push_back(oracle_prior(scenario));
    } else {
      violations.add(unknown_prior(scenario, name));
    }
  }
}

std::vector<scenario::NamedPrior*> ChosenPriors::having(const std::string& key, std::string& parameter) {
  std::vector<scenario::NamedPrior*> found;
  parameter = key;
  for (scenario::NamedPrior& prior : priors_)
    if (prior.parameters.find(key) >= 0) found.push_back(&prior);
  if (!found.empty()) return found;
  for (scenario::NamedPrior& prior : priors_) {
    if (!key.starts_with(prior.name + ".")) continue;
    parameter = key.substr(prior.name.size() + 1);
    if (prior.parameters.find(parameter) >= 0) return {&prior};
  }
  return {};
}

void ChosenPriors::set(const std::string& key, const std::string& text, Violations& violations) {
  if (priors_.empty()) return;  // their names were wrong, which has been said
  std::string parameter;
  const auto targets = having(key, parameter);
  if (targets.empty()) {
    violations.add(unknown_option("prior." + key, keys()));
    return;
  }
  double value = 0;
  if (!from_text(text, value)) {
    violations.add(fmt::format("prior.{} = {}, must be a number", key, text));
    return;
  }
  for (scenario::NamedPrior* prior : targets) set_value(*prior, parameter, value, violations);
}

std::vector<std::string> ChosenPriors::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, text] : values()) keys.push_back(key);
  return keys;
}

std::vector<std::pair<std::string, std::string>> ChosenPriors::values() const {
  std::vector<std::pair<std::string, std::string>> values;
  for (const scenario::NamedPrior& prior : priors_) {
    if (prior.name == scenario::kOracle) continue;
    const std::string prefix = priors_.size() > 1 ? "prior." + prior.name + "." : "prior.";
    for (const Parameter& parameter : prior.parameters.all())
      values.emplace_back(prefix + parameter.name, to_text(parameter.value));
  }
  return values;
}

std::optional<prior::Prior> ChosenPriors::prior() const {
  std::vector<prior::Prior> priors;
  for (const scenario::NamedPrior& p : priors_) priors.push_back({p.name, p.simulator, p.parameters, p.driven});
  if (priors.empty()) return std::nullopt;
  return priors.size() == 1 ? priors.front() : prior::choice(priors);
}

}  // namespace rehearse::experiment
