#include "rehearse/robot_file/start.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/names.hpp"
#include "rehearse/expression/program.hpp"
#include "rehearse/robot_file/formulas.hpp"

namespace rehearse::robot_file {
namespace {

/// The words of a formula that may be names.
std::set<std::string> words_of(const std::string& formula) {
  const auto is_part = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  std::set<std::string> words;
  for (std::size_t at = 0; at < formula.size(); ++at) {
    std::size_t end = at;
    while (end < formula.size() && is_part(static_cast<unsigned char>(formula[end]))) ++end;
    if (end > at) words.insert(formula.substr(at, end - at));
    at = std::max(at, end);
  }
  return words;
}

/// Formulas and the values of their names.
class StartValues {
 public:
  void input(const std::string& name, double value, const std::string& unit) {
    formulas_.input(name, expression::Pace::always);
    values_.push_back(value);
    units_.emplace_back(name, unit);
  }

  void define(const Definitions& definitions) {
    for (const auto& [name, formula] : definitions) {
      formulas_.define(name, formula.text);
      units_.emplace_back(name, "");
    }
  }

  double value_of(const std::string& formula) const {
    expression::Formulas formulas = formulas_;
    const expression::Program program(formulas, {formulas.compile(formula)});
    std::vector<const double*> columns;
    for (const double& value : values_) columns.push_back(&value);
    Matrix result(1, 1);
    program.run(columns, result);
    return result(0, 0);
  }

  /// "theta = 0 rad, m = 1", of the names in the formula.
  std::string values_in(const std::string& formula) const {
    const std::set<std::string> words = words_of(formula);
    std::vector<std::string> values;
    for (const auto& [name, unit] : units_) {
      if (!words.contains(name)) continue;
      const double found = value_of(name), value = std::isnan(found) ? std::abs(found) : found;  // no "-nan"
      values.push_back(fmt::format("{} = {:g}{}", name, value, unit_text(unit)));
    }
    return fmt::format("{}", fmt::join(values, ", "));
  }

 private:
  expression::Formulas formulas_;
  std::vector<double> values_;                              // of the inputs
  std::vector<std::pair<std::string, std::string>> units_;  // of inputs, then of definitions
};

class StartChecker {
 public:
  StartChecker(const Robot& robot, const Task& task, files::FileViolations& violations)
      : robot_(robot), task_(task), violations_(violations) {}

  void check_task() {
    const StartValues values = values_of_step();
    const RewardFormulas& reward = robot_.reward;
    require_finite(values, "reward.formula", reward.formula);
    for (const Formula& distance : reward.distance) require_finite(values, "reward.distance", distance);
    require_finite(values, "success.when", robot_.success.when);
    if (require_finite(values, "ended", robot_.ended) && is_true(values.value_of(robot_.ended.text)))
      add(values, "ended", robot_.ended, "holds at the start");
    if (!reward.cost.empty()) check_cost();
  }

  void check_rates(const Variant& variant, const std::string& where) {
    const auto* equations = std::get_if<Equations>(&robot_.dynamics_of(variant).source);
    if (!equations) return;
    StartValues values;
    for (const Parameter& parameter : variant.parameters.all())
      values.input(parameter.name, parameter.value, parameter.unit);
    add_actions(values);
    add_states(values, static_cast<Index>(robot_.states.size()));
    values.define(equations->definitions);
    for (std::size_t i = 0; i < equations->rates.size(); ++i)
      require_finite(values, fmt::format("{}: rate.{}", where, robot_.states[i].variable.name), equations->rates[i]);
  }

 private:
  /// In the first step there is no action before, and no time is past.
  void check_cost() {
    StartValues values = values_of_step();
    const auto zero = [&](const std::string& name, const std::string& unit) {
      if (!is_own_name(robot_, name)) values.input(name, 0, unit);
    };
    for (const ActionVariable& action : robot_.actions) zero(action.name + "_before", action.unit);
    zero("time", "s");
    require_finite(values, "reward.cost", robot_.reward.cost);
  }

  StartValues values_of_step() const {
    StartValues values;
    add_states(values, task_.state_size());
    add_actions(values);
    values.define(robot_.definitions);
    return values;
  }

  void add_states(StartValues& values, Index count) const {
    for (Index i = 0; i < count; ++i) {
      const StateVariable& state = task_.states[static_cast<std::size_t>(i)];
      values.input(state.name, task_.start_mean(i), state.unit);
    }
  }

  void add_actions(StartValues& values) const {
    for (const ActionVariable& action : robot_.actions)
      values.input(action.name, 0.5 * (action.bounds.low + action.bounds.high), action.unit);
  }

  /// False: there is no such formula, or it has no finite value.
  bool require_finite(const StartValues& values, const std::string& key, const Formula& formula) {
    if (formula.empty() || formula.is_function()) return false;
    if (std::isfinite(values.value_of(formula.text))) return true;
    add(values, key, formula, "is not finite at the start");
    return false;
  }

  void add(const StartValues& values, const std::string& key, const Formula& formula, const std::string& what) {
    const std::string at = values.values_in(formula.text);
    violations_.add(formula.line, fmt::format("{}: \"{}\" {}{}", key, formula.text, what,
                                              at.empty() ? "" : fmt::format(" ({})", at)));
  }

  const Robot& robot_;
  const Task& task_;
  files::FileViolations& violations_;
};

}  // namespace

void check_start(const Robot& robot, const Task& task, files::FileViolations& violations) {
  StartChecker checker(robot, task, violations);
  checker.check_task();
  if (robot.has_plant_dynamics()) checker.check_rates(robot.plant, "plant");
  for (const Variant& prior : robot.priors) checker.check_rates(prior, "prior " + prior.name);
}

}  // namespace rehearse::robot_file
