#include "rehearse/core/parameters.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/options.hpp"

namespace rehearse {
namespace {

std::string violation(const Parameter& p, double value) {
  if (!std::isfinite(value)) return fmt::format("{} = {}, must be finite", p.name, to_text(value));
  if (p.kind == Parameter::Kind::continuous && (value < p.box.low || value > p.box.high))
    return fmt::format("{} = {}, must be between {} and {}", p.name, to_text(value), to_text(p.box.low),
                       to_text(p.box.high));
  if (!p.choices.empty() && std::find(p.choices.begin(), p.choices.end(), value) == p.choices.end())
    return fmt::format("{} = {}, must be one of {}", p.name, to_text(value), fmt::join(p.choices, ", "));
  return {};
}

void check_choices(const Parameter& p, Violations& violations) {
  violations.require(!p.choices.empty(), fmt::format("parameter {} has no choices", p.name));
  for (auto i = p.choices.begin(); i != p.choices.end(); ++i) {
    violations.require(std::isfinite(*i), fmt::format("parameter {}: choice {} must be finite", p.name, *i));
    violations.require(std::find(p.choices.begin(), i, *i) == i,
                       fmt::format("parameter {}: choice {} appears twice", p.name, *i));
  }
}

}  // namespace

Parameter Parameter::fixed(std::string name, double value, std::string unit) {
  return {.name = std::move(name), .unit = std::move(unit), .value = value};
}

Parameter Parameter::continuous(std::string name, double value, Interval box, std::string unit) {
  return {.name = std::move(name), .unit = std::move(unit), .value = value, .kind = Kind::continuous, .box = box};
}

Parameter Parameter::discrete(std::string name, double value, std::vector<double> choices, std::string unit) {
  return {.name = std::move(name),
          .unit = std::move(unit),
          .value = value,
          .kind = Kind::discrete,
          .choices = std::move(choices)};
}

ParameterSpace::ParameterSpace(std::vector<Parameter> parameters) : parameters_(std::move(parameters)) {
  Violations violations;
  for (Index i = 0; i < size(); ++i) {
    const Parameter& p = (*this)[i];
    violations.require(!p.name.empty(), fmt::format("parameter {} has no name", i));
    violations.require(find(p.name) == i, fmt::format("parameter {} appears twice", p.name));
    if (p.kind == Parameter::Kind::continuous)
      violations.require(std::isfinite(p.box.low) && std::isfinite(p.box.high) && p.box.low < p.box.high,
                         fmt::format("parameter {} needs a finite box with low < high", p.name));
    if (p.kind == Parameter::Kind::discrete) check_choices(p, violations);
    const std::string line = violation(p, p.value);
    violations.require(line.empty(), line);
  }
  violations.throw_if_any();
}

Vector ParameterSpace::values() const {
  Vector phi(size());
  for (Index i = 0; i < size(); ++i) phi(i) = (*this)[i].value;
  return phi;
}

Index ParameterSpace::find(std::string_view name) const {
  for (Index i = 0; i < size(); ++i)
    if ((*this)[i].name == name) return i;
  return -1;
}

std::vector<std::string> ParameterSpace::names() const {
  std::vector<std::string> names;
  for (const Parameter& p : parameters_) names.push_back(p.name);
  return names;
}

std::vector<Index> ParameterSpace::of_kind(Parameter::Kind kind) const {
  std::vector<Index> indices;
  for (Index i = 0; i < size(); ++i)
    if ((*this)[i].kind == kind) indices.push_back(i);
  return indices;
}

bool ParameterSpace::has_tunable() const {
  return std::any_of(parameters_.begin(), parameters_.end(), [](const Parameter& p) { return p.tunable(); });
}

Parameter& ParameterSpace::at(std::string_view name) {
  const Index i = find(name);
  if (i < 0) throw InvalidInput(fmt::format("unknown parameter '{}'{}", name, suggestions(name, names())));
  return parameters_[static_cast<std::size_t>(i)];
}

void ParameterSpace::set_value(std::string_view name, double value) {
  Parameter& parameter = at(name);
  const std::string line = violation(parameter, value);
  if (!line.empty()) throw InvalidInput(line);
  parameter.value = value;
}

ParameterSpace ParameterSpace::tunable_in(Interval box, const std::vector<std::string>& names) const {
  ParameterSpace tunable = *this;
  for (const std::string& name : names) {
    Parameter& parameter = tunable.at(name);
    parameter = Parameter::continuous(parameter.name, parameter.value, box, parameter.unit);
  }
  return ParameterSpace(std::move(tunable.parameters_));
}

ParameterSpace ParameterSpace::fixed_at(const Vector& phi) const {
  std::vector<Parameter> fixed = parameters_;
  for (Index i = 0; i < size(); ++i) {
    fixed[static_cast<std::size_t>(i)].kind = Parameter::Kind::fixed;
    fixed[static_cast<std::size_t>(i)].value = phi(i);
  }
  return ParameterSpace(std::move(fixed));
}

}  // namespace rehearse
