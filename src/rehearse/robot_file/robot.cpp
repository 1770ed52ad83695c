#include "rehearse/robot_file/robot.hpp"

#include <algorithm>
#include <stdexcept>

namespace rehearse::robot_file {

std::vector<std::string> Robot::state_names() const {
  std::vector<std::string> names;
  for (const State& state : states) names.push_back(state.variable.name);
  return names;
}

std::vector<std::string> Robot::task_state_names() const {
  std::vector<std::string> names = state_names();
  for (const StateVariable& memory : actuators().variables()) names.push_back(memory.name);
  return names;
}

Actuators Robot::plant_actuators() const {
  std::vector<ActionVariable> own = actions;
  for (std::size_t a = 0; a < own.size(); ++a) own[a].actuation = plant_actuation[a];
  return {own, dt_s, 0};
}

std::vector<std::string> Robot::action_names() const {
  std::vector<std::string> names;
  for (const ActionVariable& action : actions) names.push_back(action.name);
  return names;
}

const Dynamics& Robot::dynamics_of(const Variant& variant) const {
  const auto found = std::ranges::find(dynamics, variant.dynamics, &Dynamics::name);
  if (found == dynamics.end()) throw std::logic_error("a variant without dynamics");
  return *found;
}

system::OdeFormulas Robot::equation(const Dynamics& of) const {
  system::OdeFormulas equation{.states = state_names(), .actions = action_names()};
  for (const Parameter& parameter : of.parameters) equation.parameters.push_back(parameter.name);
  for (const State& state : states)
    if (state.variable.kind == StateKind::angle) equation.angles.push_back(state.variable.name);
  const auto& equations = std::get<Equations>(of.source);
  for (const auto& [name, formula] : equations.definitions) equation.definitions.emplace_back(name, formula.text);
  for (const Formula& rate : equations.rates) equation.slopes.push_back(rate.text);
  return equation;
}

}  // namespace rehearse::robot_file
