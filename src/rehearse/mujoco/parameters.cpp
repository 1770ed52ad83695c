#include "rehearse/mujoco/parameters.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace rehearse::mujoco {
namespace {

std::string text_of(const Target& target) {
  const std::string component = target.component < 0 ? "" : fmt::format("[{}]", target.component);
  return fmt::format("{} '{}' {}{}", target.kind, target.element, target.field, component);
}

std::string text_of(const ModelParameter& parameter) { return fmt::format("parameter '{}'", parameter.name); }

void require_numbers(const ModelParameter& parameter, const Target& target, Violations& violations) {
  const std::string where = fmt::format("{}, {}", text_of(parameter), text_of(target));
  violations.require(std::isfinite(target.factor),
                     fmt::format("{}: factor = {}, must be finite", where, target.factor));
  violations.require(std::isfinite(target.power), fmt::format("{}: power = {}, must be finite", where, target.power));
}

bool overlap(const Entries& a, const Entries& b) {
  return a.field == b.field && a.id == b.id && a.begin < b.end && b.begin < a.end;
}

}  // namespace

double Parameters::Move::by(const Vector& phi) const {
  return factor * (power == 1 ? phi(parameter) : std::pow(phi(parameter), power));
}

Parameters::Parameters(mjModel& original, const std::vector<ModelParameter>& parameters, Violations& violations)
    : size_(static_cast<Index>(parameters.size())) {
  for (Index p = 0; p < size_; ++p) {
    const ModelParameter& parameter = parameters[static_cast<std::size_t>(p)];
    const bool twice = std::any_of(parameters.begin(), parameters.begin() + p,
                                   [&](const ModelParameter& other) { return other.name == parameter.name; });
    violations.require(!twice, fmt::format("{} stands twice", text_of(parameter)));
    violations.require(!parameter.targets.empty(), fmt::format("{} has no targets, must have one", text_of(parameter)));
    for (const Target& target : parameter.targets) {
      require_numbers(parameter, target, violations);
      const Entries entries = find_entries(original, target, text_of(parameter), violations);
      const bool scale = target.apply == Target::Apply::scale;
      if (entries.field) moves_.push_back({entries, p, target.factor, target.power, scale});
    }
  }
  std::stable_partition(moves_.begin(), moves_.end(), [](const Move& move) { return !move.scale; });
  check_conflicts(parameters, violations);
}

/// Two that set the same number are a mistake: the first would do nothing. So is one that moves the same number twice.
void Parameters::check_conflicts(const std::vector<ModelParameter>& parameters, Violations& violations) const {
  for (std::size_t i = 0; i < moves_.size() && !moves_[i].scale; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!overlap(moves_[i].entries, moves_[j].entries)) continue;
      violations.add(fmt::format("'{}' and '{}' both set the {} of the same {}, must be one",
                                 parameters[static_cast<std::size_t>(moves_[j].parameter)].name,
                                 parameters[static_cast<std::size_t>(moves_[i].parameter)].name,
                                 moves_[i].entries.field->name, moves_[i].entries.field->kind));
    }
  for (std::size_t i = 0; i < moves_.size(); ++i)
    for (std::size_t j = 0; j < i && moves_[i].scale; ++j)
      if (moves_[j].parameter == moves_[i].parameter && overlap(moves_[i].entries, moves_[j].entries))
        violations.add(
            fmt::format(fmt::runtime(moves_[j].scale ? "'{}' scales the {} of the same {} twice, must be once"
                                                     : "'{}' sets and scales the {} of the same {}, must do one"),
                        parameters[static_cast<std::size_t>(moves_[i].parameter)].name, moves_[i].entries.field->name,
                        moves_[i].entries.field->kind));
}

bool Parameters::apply(mjModel& original, const Vector& phi, mjModel& model) const {
  for (const Move& move : moves_) std::copy_n(move.entries.at(original), move.entries.size(), move.entries.at(model));
  bool constants = false;
  for (const Move& move : moves_) {
    double* const numbers = move.entries.at(model);
    for (int i = 0; i < move.entries.size(); ++i) numbers[i] = (move.scale ? numbers[i] : 1) * move.by(phi);
    move.entries.field->follow(model, move.entries.id);
    constants = constants || move.entries.field->constants;
  }
  return constants;
}

}  // namespace rehearse::mujoco
