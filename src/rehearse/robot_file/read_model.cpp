#include "rehearse/robot_file/read_model.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include <fmt/format.h>

#include "rehearse/core/names.hpp"
#include "rehearse/robot_file/variant.hpp"

namespace rehearse::robot_file {
namespace {

using mujoco::Target, mujoco::Term;
using Kind = mujoco::State::Kind;

struct KindName {
  const char* key;
  Kind kind;
};
constexpr std::array<KindName, 5> kKinds = {{{"position", Kind::position},
                                             {"velocity", Kind::velocity},
                                             {"sensor", Kind::sensor},
                                             {"body", Kind::body},
                                             {"site", Kind::site}}};

class ModelReader {
 public:
  ModelReader(const Robot& robot, files::FileViolations& violations) : robot_(robot), violations_(violations) {}

  std::vector<mujoco::State> states(const toml::table* given) {
    std::vector<mujoco::State> states;
    for (const State& state : robot_.states) states.push_back(by_default(state.variable.name));
    refuse_unknown(given, robot_.state_names(), "state");
    for (mujoco::State& state : states)
      if (const toml::node* node = given ? given->get(state.name) : nullptr) read(*node, state);
    add_velocities(given, states);
    return states;
  }

  std::vector<mujoco::Action> actions(const toml::table* given) {
    refuse_unknown(given, robot_.action_names(), "action");
    std::vector<mujoco::Action> actions;
    for (const std::string& name : robot_.action_names()) {
      actions.push_back({.element = name});
      if (const toml::node* node = given ? given->get(name) : nullptr) read(name, *node, actions.back());
    }
    return actions;
  }

 private:
  /// The joint of its name.
  static mujoco::State by_default(const std::string& name) { return {.name = name, .terms = {{name}}}; }

  void refuse_unknown(const toml::table* given, const std::vector<std::string>& names, const char* what) {
    if (!given) return;
    for (const auto& [name, node] : in_order(*given))
      if (!is_among(name, names))
        violations_.add(files::line_of(*node),
                        fmt::format("there is no {} '{}'{}", what, name, did_you_mean(name, names)));
  }

  /// A state that is the rate of another is the velocity of the same joints, if nothing else is said.
  void add_velocities(const toml::table* given, std::vector<mujoco::State>& states) const {
    for (std::size_t i = 0; i < states.size(); ++i)
      for (mujoco::State& rate : states) {
        if (robot_.states[i].variable.rate != rate.name || (given && given->contains(rate.name))) continue;
        rate.kind = Kind::velocity;
        rate.terms = states[i].terms;
      }
  }

  void read(const toml::node& node, mujoco::State& state) {
    if (const auto joint = node.value<std::string>()) {
      state.terms = {{*joint}};
      return;
    }
    const toml::table* part = node.as_table();
    if (!part)
      return violations_.add(files::line_of(node),
                             fmt::format("state.{} must be the name of a joint, or say what it is: {{ velocity = "
                                         "\"…\" }}, {{ position = [\"…\", \"…\"] }}",
                                         state.name));
    Table table(*part, "state." + state.name, violations_);
    table.number("offset", state.offset);
    Index component = 0;
    table.reader().take_fields([&](FieldVisitor& v) { v.integer("component", component, "", between(0, 100)); });
    Index said = 0;
    for (const KindName& each : kKinds)
      if (const toml::node* terms = table.reader().take(each.key)) {
        state.kind = each.kind;
        state.terms = terms_of(state.name, *terms, component);
        ++said;
      }
    if (said != 1)
      table.wrong("position",
                  fmt::format("state.{} must be one of position, velocity, sensor, body and site", state.name));
    table.finish();
  }

  /// A name, a list of names that are added, or a table of names with factors.
  std::vector<Term> terms_of(const std::string& state, const toml::node& node, Index component) {
    std::vector<Term> terms;
    if (const auto name = node.value<std::string>()) terms.push_back({*name, 1, component});
    if (const toml::array* names = node.as_array())
      for (const toml::node& name : *names) terms.push_back({name.value<std::string>().value_or(""), 1, component});
    if (const toml::table* factors = node.as_table())
      for (const auto& [name, factor] : in_order(*factors))
        if (double value = 0; take_number(fmt::format("the factor of {}", name), *factor, value, violations_))
          terms.push_back({name, value, component});
    if (terms.empty())
      violations_.add(files::line_of(node),
                      fmt::format("state.{} must be a name, a list of names, or names with factors", state));
    return terms;
  }

  void read(const std::string& name, const toml::node& node, mujoco::Action& action) {
    if (const auto actuator = node.value<std::string>()) {
      action.element = *actuator;
      return;
    }
    const toml::table* part = node.as_table();
    if (!part || part->size() != 1 || !(*part)["joint"].is_string())
      return violations_.add(files::line_of(node),
                             fmt::format("action.{} must be the name of an actuator, or {{ joint = "
                                         "\"…\" }}, which it pushes",
                                         name));
    action = {*(*part)["joint"].value<std::string>(), mujoco::Action::Kind::joint};
  }

  const Robot& robot_;
  files::FileViolations& violations_;
};

/// "body link1 mass", "geom foot friction 0", "option gravity 2"; false: it is something else.
bool split(const std::string& text, Target& target) {
  std::istringstream words(text);
  words >> target.kind;
  if (target.kind != "option") words >> target.element;
  words >> target.field;
  if (!words) return false;
  if (words >> std::ws; words.eof()) return true;
  return static_cast<bool>(words >> target.component) && (words >> std::ws).eof();
}

class TargetReader {
 public:
  TargetReader(mujoco::ModelParameter& parameter, Target::Apply apply, files::FileViolations& violations)
      : parameter_(parameter), apply_(apply), violations_(violations) {}

  void read(const toml::node& node) {
    if (const toml::array* several = node.as_array()) {
      for (const toml::node& each : *several) read(each);
      return;
    }
    Target target{.apply = apply_};
    const toml::table* part = node.as_table();
    const toml::node* what = part ? part->get("what") : &node;
    if (part) {
      Table table(*part, parameter_.name, violations_);
      table.reader().take("what");
      table.number("factor", target.factor);
      table.number("power", target.power);
      table.finish();
    }
    const auto text = what ? what->value<std::string>() : std::nullopt;
    if (!text || !split(*text, target))
      return violations_.add(files::line_of(node),
                             fmt::format("parameter {} must set or scale \"KIND ELEMENT FIELD\", for instance \"body "
                                         "link mass\", \"joint hip damping\", \"geom foot friction 0\"",
                                         parameter_.name));
    parameter_.targets.push_back(target);
  }

 private:
  mujoco::ModelParameter& parameter_;
  Target::Apply apply_;
  files::FileViolations& violations_;
};

}  // namespace

ModelSource model_of(Table& table, const Robot& robot, files::FileViolations& violations) {
  ModelSource model;
  table.reader().take("keyframe", model.keyframe);
  table.reader().take_fields([&](FieldVisitor& v) { v.integer("substeps", model.substeps, "", between(1, 1e5)); });
  ModelReader reader(robot, violations);
  model.states = reader.states(table.reader().take_table("state"));
  model.actions = reader.actions(table.reader().take_table("action"));
  return model;
}

std::map<std::string, Index> lines_of_model(const toml::table& part, const ModelSource& model,
                                            const std::vector<std::string>& actions) {
  std::map<std::string, Index> lines;
  const auto add = [&](const std::string& beginning, const toml::node* node) {
    if (node) lines.emplace(beginning, files::line_of(*node));
  };
  for (const mujoco::State& state : model.states)
    add(fmt::format("state '{}'", state.name), part["state"][state.name].node());
  for (std::size_t a = 0; a < actions.size(); ++a)
    add(fmt::format("action '{}'", model.actions[a].element), part["action"][actions[a]].node());
  for (const mujoco::ModelParameter& parameter : model.parameters)
    add(fmt::format("parameter '{}'", parameter.name), part["parameters"][parameter.name].node());
  add("keyframe", part["keyframe"].node());
  return lines;
}

mujoco::ModelParameter moved_by(Table& entry, mujoco::ModelParameter parameter, files::FileViolations& violations) {
  for (const auto& [key, apply] : {std::pair{"sets", Target::Apply::value}, std::pair{"scales", Target::Apply::scale}})
    if (const toml::node* node = entry.reader().take(key)) TargetReader(parameter, apply, violations).read(*node);
  if (parameter.targets.empty())
    entry.wrong("sets", fmt::format("parameter {} must say what it sets or scales", parameter.name));
  return parameter;
}

}  // namespace rehearse::robot_file
