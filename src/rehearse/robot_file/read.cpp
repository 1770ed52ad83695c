#include "rehearse/robot_file/read.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/names.hpp"
#include "rehearse/expression/formulas.hpp"
#include "rehearse/robot_file/read_dynamics.hpp"
#include "rehearse/robot_file/read_states.hpp"
#include "rehearse/robot_file/table.hpp"
#include "rehearse/robot_file/variant.hpp"

namespace rehearse::robot_file {
namespace {

constexpr std::int64_t kFormat = 1;

class Reader {
 public:
  Reader(const toml::table& file, const std::string& source, const scenario::ReadFile& read_file,
         const Functions& functions)
      : read_file_(read_file), violations_(source), file_(file, "", violations_) {
    robot_.functions = functions;
  }

  Robot read() {
    read_head();
    robot_.states = read_states(file_, names_, violations_);
    required(!robot_.states.empty(), "[[state]]", "states that the robot measures");
    read_actions();
    robot_.definitions = file_.definitions("define");
    read_task();
    read_dynamics(file_, robot_, read_file_, violations_);
    read_plant();
    read_priors();
    const bool asked = robot_.has_plant_dynamics() || !robot_.priors.empty();
    required(!asked || !robot_.dynamics.empty(), "[dynamics.NAME]", "how the states change");
    read_policy();
    read_bodies();
    file_.finish();
    violations_.throw_if_any();
    return std::move(robot_);
  }

 private:
  void read_head() {
    const toml::node* format = file_.reader().take("format");
    if (!format || format->value_exact<std::int64_t>() != kFormat)
      violations_.add(
          format ? files::line_of(*format) : 0,
          format ? fmt::format("format must be {}", kFormat) : fmt::format("a robot begins with format = {}", kFormat));
    file_.reader().take("name", robot_.name);
    if (!is_word(robot_.name))
      file_.wrong("name", fmt::format("name = '{}', must be of letters, digits, - and _", robot_.name));
    file_.reader().take("summary", robot_.summary);
    required(file_.number("dt_s", robot_.dt_s, {.low = 0, .high = 1e6, .low_open = true}), "dt_s",
             "seconds of a control step");
    required(file_.reader().has("horizon"), "horizon", "control steps of an episode");
    file_.reader().take_fields([&](FieldVisitor& v) { v.integer("horizon", robot_.horizon, "", between(1, 1e6)); });
  }

  void required(bool there, const std::string& key, const std::string& what) {
    if (!there) violations_.add(0, fmt::format("{} is missing: {}", key, what));
  }

  void read_actions() {
    for (const toml::table* part : file_.list("action")) {
      Table table(*part, "[[action]]", violations_);
      ActionVariable action;
      table.name(action.name, names_, "an action needs a name");
      table.unit(action.unit);
      if (!table.interval("bounds", action.bounds)) table.wrong("bounds", "an action needs bounds = [low, high]");
      read_actuation(table, action.actuation);
      table.finish();
      name_memory(action, files::line_of(*part));
      robot_.actions.push_back(action);
    }
    required(!robot_.actions.empty(), "[[action]]", "actions that move the robot");
  }

  void read_actuation(Table& table, Actuation& actuation) {
    table.reader().take_fields([&](FieldVisitor& v) {
      v.number("max_rate", actuation.max_rate, "", above(0));
      v.number("filter_s", actuation.filter_s, "", at_least(0));
      v.number("delay_s", actuation.delay_s, "", between(0, longest_delay_s()));
      v.number("lag_s", actuation.lag_s, "", at_least(0));
      v.integer("remember", actuation.remember, "", between(0, Actuators::kMostSteps));
    });
  }

  /// The longest delay allowed; any while the control step is wrong.
  double longest_delay_s() const { return robot_.dt_s > 0 ? Actuators::kMostSteps * robot_.dt_s : kInf; }

  /// Formulas may use what an action's actuators remember.
  void name_memory(const ActionVariable& action, Index line) {
    if (!(robot_.dt_s > 0) || !Actuators::violations(action, robot_.dt_s).empty()) return;
    for (const StateVariable& memory : Actuators({action}, robot_.dt_s, 0).variables()) {
      try {
        names_.input(memory.name, expression::Pace::always);
      } catch (const InvalidInput& error) {
        violations_.add(line, fmt::format("{}, which is a state that the actuators of {} add: {}", memory.name,
                                          action.name, error.what()));
      }
    }
  }

  void read_task() {
    if (const toml::table* part = file_.reader().take_table("reward")) {
      Table table(*part, "[reward]", violations_);
      robot_.reward.distance = table.formulas("distance");
      robot_.reward.formula = table.formula("formula");
      table.number("width", robot_.reward.width, above(0));
      table.number("floor", robot_.reward.floor);
      robot_.reward.cost = table.formula("cost");
      robot_.reward.episode = table.formula("episode");
      if (robot_.reward.distance.empty() && robot_.reward.formula.empty())
        violations_.add(files::line_of(*part),
                        "[reward] needs distance = […], which is 0 at the goal, or formula = \"…\"");
      if (!robot_.reward.distance.empty() && !robot_.reward.formula.empty())
        table.wrong("formula", "[reward] has distance and formula, must have one of them");
      table.finish();
    } else {
      required(false, "[reward]", "the reward of each step");
    }
    if (const toml::table* part = file_.reader().take_table("success")) {
      Table table(*part, "[success]", violations_);
      robot_.success.when = table.formula("when");
      if (robot_.success.when.empty()) table.wrong("when", "[success] needs when = \"…\", a condition");
      table.number("last_s", robot_.success.last_s, at_least(0));
      const double episode_s = robot_.dt_s * static_cast<double>(robot_.horizon);
      if (robot_.success.last_s > episode_s * (1 + 1e-9) && episode_s > 0)
        table.wrong("last_s",
                    fmt::format("last_s = {} is more than the {} s of an episode", robot_.success.last_s, episode_s));
      table.finish();
    }
    robot_.ended = file_.formula("ended");
    read_limits();
  }

  void read_limits() {
    for (const toml::table* part : file_.list("limit")) {
      Table table(*part, "[[limit]]", violations_);
      LimitFormula limit;
      limit.keep = table.formula("keep");
      if (limit.keep.empty()) table.wrong("keep", "a limit needs keep = \"…\", a condition that every step must keep");
      limit.name = limit.keep.text;
      table.reader().take("name", limit.name);
      table.number("risk", limit.risk, between(0.001, 0.999));
      table.finish();
      robot_.limits.push_back(std::move(limit));
    }
  }

  void read_plant() {
    const toml::table* part = file_.reader().take_table("plant");
    robot_.plant_actuation.resize(robot_.actions.size());
    if (!part) return;
    Table table(*part, "[plant]", violations_);
    const bool has_noise = read_measurement_noise(table);
    robot_.has_plant = true;
    if (table.reader().take("function", robot_.plant_function)) {
      require_function(robot_.functions, robot_.functions.plants, robot_.plant_function, files::line_of(*part),
                       violations_);
      if (has_noise) table.wrong("measurement_noise", "a plant that is a function measures by itself, noise included");
    } else {
      robot_.plant = read_variant("plant", table, robot_.dynamics, violations_);
      for (std::size_t a = 0; a < robot_.actions.size(); ++a) {
        robot_.plant_actuation[a].delay_s = robot_.actions[a].actuation.delay_s;
        robot_.plant_actuation[a].lag_s = robot_.actions[a].actuation.lag_s;
      }
    }
    read_plant_actuation(table, "delay_s", &Actuation::delay_s, between(0, longest_delay_s()));
    read_plant_actuation(table, "lag_s", &Actuation::lag_s, at_least(0));
    table.finish();
  }

  /// A number of all states, or STATE = number of each that has some; whether any has.
  bool read_measurement_noise(Table& table) {
    scenario::OdeOptions& options = robot_.options;
    const toml::node* node = table.reader().take("measurement_noise");
    if (node && node->is_array()) {
      table.wrong("measurement_noise", "measurement_noise must be a number, or one for each state: { NAME = 0.01 }");
      return false;
    }
    if (!node || !node->is_table()) {
      table.number("measurement_noise", options.measurement_noise, at_least(0));
      return options.measurement_noise > 0;
    }
    Table entry(*node->as_table(), "[plant] measurement_noise", violations_);
    for (const std::string& name : robot_.state_names()) {
      options.measurement_noises.push_back(Parameter::fixed(name, 0));
      entry.number(name, options.measurement_noises.back().value, at_least(0));
    }
    entry.finish();
    return std::any_of(options.measurement_noises.begin(), options.measurement_noises.end(),
                       [](const Parameter& noise) { return noise.value > 0; });
  }

  /// NAME = number, of an action.
  void read_plant_actuation(Table& table, const std::string& key, double Actuation::*field, const Bound& bound) {
    const toml::table* given = table.reader().take_table(key);
    if (!given) return;
    Table entry(*given, "[plant] " + key, violations_);
    for (std::size_t a = 0; a < robot_.actions.size(); ++a)
      entry.number(robot_.actions[a].name, robot_.plant_actuation[a].*field, bound);
    entry.finish();
  }

  void read_priors() {
    for (const auto& [name, part] : file_.tables("prior")) {
      check_prior_name(name, files::line_of(*part));
      Table table(*part, fmt::format("[prior.{}]", name), violations_);
      Variant prior = read_variant(name, table, robot_.dynamics, violations_);
      tune(table, prior, robot_.dynamics, violations_);
      table.finish();
      robot_.priors.push_back(std::move(prior));
    }
  }

  void check_prior_name(const std::string& name, Index line) {
    if (!is_word(name))
      violations_.add(line, fmt::format("the name of prior '{}' must be of letters, digits, - and _", name));
    if (name == scenario::kOracle)
      violations_.add(line, fmt::format("'{}' is the plant's own dynamics, and no name of a prior", name));
  }

  void read_policy() {
    if (const toml::table* part = file_.reader().take_table("policy")) {
      files::TomlReader reader(*part, "[policy]", violations_);
      reader.take_fields([&](FieldVisitor& v) { robot_.options.policy.fields(v); });
      reader.finish();
      for (const auto& [key, value] : *part) robot_.stated.emplace_back(key.str());
    }
  }

  void read_bodies() {
    for (const toml::table* part : file_.list("body")) {
      Table table(*part, "[[body]]", violations_);
      Body body;
      if (!table.reader().take("name", body.name)) table.wrong("name", "a body needs a name");
      const auto from = table.formulas("from"), to = table.formulas("to");
      if (from.size() != 2 || to.size() != 2)
        violations_.add(files::line_of(*part), "a body goes from = [x, y] to = [x, y], formulas in m");
      else
        std::copy(from.begin(), from.end(), body.from), std::copy(to.begin(), to.end(), body.to);
      table.number("width_m", body.width_m, above(0));
      table.finish();
      robot_.bodies.push_back(body);
    }
  }

  const scenario::ReadFile& read_file_;
  files::FileViolations violations_;
  Table file_;
  expression::Formulas names_;  // of states and actions
  Robot robot_;
};

}  // namespace

Robot read(std::string_view text, const std::string& source, const scenario::ReadFile& read_file,
           const Functions& functions) {
  const toml::table file = files::parse_toml(text, source);
  return Reader(file, source, read_file, functions).read();
}

}  // namespace rehearse::robot_file
