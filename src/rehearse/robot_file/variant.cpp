#include "rehearse/robot_file/variant.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rehearse::robot_file {
namespace {

/// The dynamics that the table names, or without that key the first. Null, and a violation, if there is none of that
/// name.
const Dynamics* named_dynamics(Table& table, const std::vector<Dynamics>& dynamics, std::string& name) {
  if (!table.reader().take("dynamics", name) && !dynamics.empty()) name = dynamics.front().name;
  std::vector<std::string> known;
  for (const Dynamics& each : dynamics) {
    if (each.name == name) return &each;
    known.push_back(each.name);
  }
  if (!known.empty())
    table.wrong("dynamics", fmt::format("there is no [dynamics.{}]{}", name, did_you_mean(name, known)));
  return nullptr;
}

class Values {
 public:
  Values(std::vector<Parameter> parameters, files::FileViolations& violations)
      : parameters_(std::move(parameters)), violations_(violations) {}

  /// Calls set(parameter, node) for every key of the table that is a parameter.
  template <class Set>
  void each(const toml::table* table, Set set) {
    if (!table) return;
    for (const auto& [name, node] : in_order(*table))
      if (Parameter* parameter = find(name, *node)) {
        set(*parameter, *node);
        lines_[name] = files::line_of(*node);
      }
  }

  /// Empty, and violations, where a parameter is wrong. line: of those that have none of their own.
  ParameterSpace space(Index line) const {
    bool right = true;
    for (const Parameter& parameter : parameters_) {
      try {
        ParameterSpace({parameter});
      } catch (const InvalidInput& error) {
        right = false;
        const auto own = lines_.find(parameter.name);
        for (const std::string& message : error.violations())
          violations_.add(own == lines_.end() ? line : own->second, message);
      }
    }
    return right ? ParameterSpace(parameters_) : ParameterSpace();
  }

 private:
  Parameter* find(const std::string& name, const toml::node& node) {
    std::vector<std::string> names;
    for (Parameter& parameter : parameters_) {
      if (parameter.name == name) return &parameter;
      names.push_back(parameter.name);
    }
    violations_.add(files::line_of(node),
                    names.empty() ? fmt::format("'{}' is no parameter: the dynamics has none", name)
                                  : fmt::format("unknown parameter '{}'{}", name, suggestions(name, names)));
    return nullptr;
  }

  std::vector<Parameter> parameters_;
  std::map<std::string, Index> lines_;
  files::FileViolations& violations_;
};

Parameter tunable(const Parameter& parameter, const toml::node& node, files::FileViolations& violations) {
  const toml::array* choices = nullptr;
  if (const toml::table* table = node.as_table(); table && table->size() == 1) choices = (*table)["choices"].as_array();
  if (choices) {
    std::vector<double> values;
    bool numbers = true;
    for (const toml::node& choice : *choices)
      numbers &=
          take_number(fmt::format("a choice of tune.{}", parameter.name), choice, values.emplace_back(), violations);
    return numbers ? Parameter::discrete(parameter.name, parameter.value, values, parameter.unit) : parameter;
  }
  const auto box = pair_of(node);
  if (box && box->low < box->high) return Parameter::continuous(parameter.name, parameter.value, *box, parameter.unit);
  violations.add(
      files::line_of(node),
      box ? fmt::format("tune.{} = [{}, {}], must be [low, high] with low < high", parameter.name, box->low, box->high)
          : fmt::format("tune.{} must be [low, high] or {{ choices = […] }}", parameter.name));
  return parameter;
}

}  // namespace

bool take_number(const std::string& name, const toml::node& node, double& value, files::FileViolations& violations) {
  if (node.is_number()) return value = *node.value<double>(), true;
  violations.add(files::line_of(node), fmt::format("{} must be a number", name));
  return false;
}

Variant read_variant(const std::string& name, Table& table, const std::vector<Dynamics>& dynamics,
                     files::FileViolations& violations) {
  Variant variant{.name = name};
  const Dynamics* of = named_dynamics(table, dynamics, variant.dynamics);
  const toml::table* given = table.reader().take_table("parameters");
  if (!of) return variant;
  Values values(of->parameters, violations);
  values.each(given, [&](Parameter& parameter, const toml::node& node) {
    take_number(parameter.name, node, parameter.value, violations);
  });
  variant.parameters = values.space(table.reader().line());
  return variant;
}

void tune(Table& table, Variant& variant, const std::vector<Dynamics>& dynamics, files::FileViolations& violations) {
  const toml::table* given = table.reader().take_table("tune");
  const auto of = std::ranges::find(dynamics, variant.dynamics, &Dynamics::name);
  const bool was_read = of != dynamics.end() && std::ssize(of->parameters) == variant.parameters.size();
  if (!given || !was_read) return;  // where it was not, a violation says so already
  Values values(variant.parameters.all(), violations);
  values.each(given,
              [&](Parameter& parameter, const toml::node& node) { parameter = tunable(parameter, node, violations); });
  variant.parameters = values.space(table.reader().line());
}

}  // namespace rehearse::robot_file
