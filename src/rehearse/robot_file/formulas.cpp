#include "rehearse/robot_file/formulas.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/names.hpp"

namespace rehearse::robot_file {

using expression::Formulas, expression::Node, expression::Pace, expression::Program;

Formulas inputs_of(const Robot& robot, Of of) {
  Formulas formulas;
  const std::vector<std::string> actions = robot.action_names();
  for (const Dynamics& dynamics : robot.dynamics)
    for (const Parameter& parameter : dynamics.parameters)
      formulas.elsewhere(parameter.name,
                         fmt::format("is a parameter, which the formulas of [dynamics.{}] alone know", dynamics.name));
  for (const std::string& name : robot.task_state_names()) formulas.input(name, Pace::always);
  for (const std::string& name : actions)
    if (of == Of::states)
      formulas.elsewhere(name, fmt::format("is an action, and this is a formula of states; the last command is the "
                                           "state {}_last, with remember = 1 in [[action]]",
                                           name));
    else
      formulas.input(name, Pace::always);
  const auto only_of_costs = [&](const std::string& name) {
    if (of != Of::costs)
      formulas.elsewhere(name, kOnlyOfCosts);
    else if (is_own_name(robot, name))
      formulas.builder().input(Pace::always);
    else
      formulas.input(name, Pace::always);
  };
  for (const std::string& name : actions) only_of_costs(name + "_before");
  only_of_costs("time");
  return formulas;
}

Formulas formulas_of(const Robot& robot, Of of) {
  Formulas all = inputs_of(robot, of);
  for (const auto& [name, formula] : robot.definitions) all.define(name, formula.text);
  return all;
}

Program program(Formulas of, const std::vector<Formula>& outputs) {
  std::vector<Node> nodes;
  nodes.reserve(outputs.size());
  for (const Formula& output : outputs) nodes.push_back(of.compile(output.text));
  return {of, nodes};
}

bool is_own_name(const Robot& robot, const std::string& name) {
  return is_among(name, robot.task_state_names()) || is_among(name, robot.action_names()) ||
         std::ranges::any_of(robot.definitions, [&](const auto& definition) { return definition.first == name; });
}

void evaluate(const Program& program, const ConstMatrixView& X, const ConstMatrixView& U, MatrixView results) {
  thread_local std::vector<const double*> columns;
  columns.clear();
  for (Index i = 0; i < X.cols(); ++i) columns.push_back(X.col(i).data());
  for (Index i = 0; i < U.cols(); ++i) columns.push_back(U.col(i).data());
  program.run(columns, results);
}

Matrix evaluate(const Program& program, const ConstMatrixView& X, const ConstMatrixView& U) {
  Matrix results(X.rows(), program.outputs());
  evaluate(program, X, U, results);
  return results;
}

void evaluate_one(const Program& program, const ConstMatrixView& X, const ConstMatrixView& U, VectorView values) {
  evaluate(program, X, U, Eigen::Map<Matrix>(values.data(), values.size(), 1));
}

}  // namespace rehearse::robot_file
