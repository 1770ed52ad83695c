#include "rehearse/robot_file/read_states.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace rehearse::robot_file {
namespace {

State read_state(Table& table, expression::Formulas& names) {
  State state;
  bool angle = false, input = true;
  table.name(state.variable.name, names, "a state needs a name");
  table.unit(state.variable.unit);
  table.reader().take_fields([&](FieldVisitor& v) {
    v.boolean("angle", angle, "");
    v.boolean("input", input, "");
    v.number("start", state.start, "");
    v.number("start_noise", state.start_noise, "", at_least(0));
    v.number("scale", state.scale, "", above(0));
  });
  if (angle && !input)
    table.wrong("input", "angle = true says how models and policies see a state, and input = false that they do not");
  constexpr std::string_view kDegrees[] = {"deg", "degree", "degrees", "°"};
  if (angle && std::ranges::count(kDegrees, state.variable.unit) > 0)
    table.wrong("unit", fmt::format("state {0}: an angle is in rad; a log in degrees says so in its header: {0} [deg]",
                                    state.variable.name));
  state.variable.kind = angle ? StateKind::angle : input ? StateKind::plain : StateKind::omitted;
  table.reader().take("rate", state.variable.rate);
  table.reader().take("parent", state.variable.parent);
  return state;
}

/// States that name others.
class Relations {
 public:
  explicit Relations(const std::vector<State>& states) : states_(states) {}

  /// An empty text: nothing is wrong.
  std::string wrong_rate(const State& state) const {
    const StateVariable& own = state.variable;
    if (own.rate.empty()) return {};
    if (!other(own.name, own.rate))
      return fmt::format("state {}: its rate '{}' is not another state{}", own.name, own.rate,
                         did_you_mean(own.rate, names_but(own.name)));
    return go_in_a_circle(state, &StateVariable::rate) ? fmt::format("state {}: its rates go in a circle", own.name)
                                                       : "";
  }

  std::string wrong_parent(const State& state) const {
    const StateVariable& own = state.variable;
    if (own.parent.empty()) return {};
    const State* parent = other(own.name, own.parent);
    if (!parent)
      return fmt::format("state {}: its parent '{}' is not another state{}", own.name, own.parent,
                         did_you_mean(own.parent, names_but(own.name)));
    const bool angles = own.kind == StateKind::angle && parent->variable.kind == StateKind::angle;
    if (!angles) return fmt::format("state {}: {} cannot carry it, both must be angles", own.name, own.parent);
    return go_in_a_circle(state, &StateVariable::parent) ? fmt::format("state {}: its parents go in a circle", own.name)
                                                         : "";
  }

 private:
  /// True if the states that each name the next one come back to one of them.
  bool go_in_a_circle(const State& state, std::string StateVariable::*next) const {
    const State* behind = &state;
    for (std::size_t i = 0; behind && i < states_.size(); ++i)
      behind = other(behind->variable.name, behind->variable.*next);
    return behind != nullptr;
  }

  /// Null: there is no other state of that name.
  const State* other(const std::string& own, const std::string& name) const {
    const auto found = std::ranges::find(states_, name, [](const State& each) { return each.variable.name; });
    return found == states_.end() || name == own ? nullptr : &*found;
  }

  std::vector<std::string> names_but(const std::string& own) const {
    std::vector<std::string> names;
    for (const State& each : states_)
      if (each.variable.name != own) names.push_back(each.variable.name);
    return names;
  }

  const std::vector<State>& states_;
};

}  // namespace

std::vector<State> read_states(Table& file, expression::Formulas& names, files::FileViolations& violations) {
  std::vector<State> states;
  std::vector<Table> tables;
  for (const toml::table* part : file.list("state")) {
    states.push_back(read_state(tables.emplace_back(*part, "[[state]]", violations), names));
    tables.back().finish();
  }
  const Relations relations(states);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (const std::string line = relations.wrong_rate(states[i]); !line.empty()) tables[i].wrong("rate", line);
    if (const std::string line = relations.wrong_parent(states[i]); !line.empty()) tables[i].wrong("parent", line);
  }
  const auto is_seen = [](const State& state) { return state.variable.kind != StateKind::omitted; };
  if (!states.empty() && std::ranges::none_of(states, is_seen))
    violations.add(tables.front().reader().line(),
                   "every [[state]] has input = false: models and policies would see nothing of the robot");
  return states;
}

}  // namespace rehearse::robot_file
