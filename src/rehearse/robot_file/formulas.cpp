#include "rehearse/robot_file/formulas.hpp"

#include <fmt/format.h>

namespace rehearse::robot_file {

using expression::Formulas, expression::Node, expression::Pace, expression::Program;

Formulas inputs_of(const Robot& robot, Of of) {
  Formulas formulas;
  for (const std::string& name : robot.task_state_names()) formulas.input(name, Pace::always);
  for (const std::string& name : robot.action_names()) {
    formulas.elsewhere(name + "_before", kOnlyOfCosts);
    if (of == Of::steps)
      formulas.input(name, Pace::always);
    else
      formulas.elsewhere(name, fmt::format("is an action, and this is a formula of states; the last command is the "
                                           "state {}_last, with remember = 1 in [[action]]",
                                           name));
  }
  formulas.elsewhere("time", kOnlyOfCosts);
  return formulas;
}

Formulas formulas_of(const Robot& robot, Of of) {
  Formulas all = inputs_of(robot, of);
  for (const auto& [name, formula] : robot.definitions) all.define(name, formula.text);
  return all;
}

Program program(Formulas of, const std::vector<Formula>& outputs) {
  std::vector<Node> nodes;
  for (const Formula& output : outputs) nodes.push_back(of.compile(output.text));
  return {of, nodes};
}

Formulas formulas_of_costs(const Robot& robot) {
  Formulas formulas = formulas_of(robot, Of::steps);
  for (const std::string& name : robot.action_names()) formulas.input(name + "_before", Pace::always);
  formulas.input("time", Pace::always);
  return formulas;
}

Matrix evaluate(const Program& program, const ConstMatrixView& X, const ConstMatrixView& U) {
  std::vector<const double*> columns;
  for (Index i = 0; i < X.cols(); ++i) columns.push_back(X.col(i).data());
  for (Index i = 0; i < U.cols(); ++i) columns.push_back(U.col(i).data());
  Matrix results(X.rows(), program.outputs());
  program.run(columns, results);
  return results;
}

}  // namespace rehearse::robot_file
