#include "rehearse/robot_file/episode_formula.hpp"

#include <fmt/format.h>

#include "rehearse/robot_file/formulas.hpp"

namespace rehearse::robot_file {
namespace {

/// The states, and the definitions that need nothing else, as formulas of their names.
std::vector<Formula> quantities_of(const Robot& robot) {
  std::vector<Formula> names;
  for (const std::string& name : robot.task_state_names()) names.push_back({name});
  expression::Formulas of_states = formulas_of(robot, Of::states);
  for (const auto& [name, formula] : robot.definitions) {
    try {
      of_states.named(name);
      names.push_back({name});
    } catch (const InvalidInput&) {  // it needs an action
    }
  }
  return names;
}

/// The inputs are those of `values_of`.
expression::Formulas formulas_of_episodes(const Robot& robot, const std::vector<Formula>& quantities) {
  expression::Formulas formulas;
  for (const char* which : {"", "_max", "_min", "_mean"})
    for (const Formula& name : quantities) formulas.input(name.text + which, expression::Pace::always);
  const char* const why =
      "is of a step, and this is a formula of a whole episode: of states, and definitions of states";
  for (const std::string& name : robot.action_names())
    for (const char* which : {"", "_before", "_max", "_min", "_mean"}) formulas.elsewhere(name + which, why);
  for (const auto& [name, formula] : robot.definitions) formulas.elsewhere(name, why);
  formulas.elsewhere("time", kOnlyOfCosts);
  return formulas;
}

/// One row: quantities at the end, then their largest, smallest and mean values.
Matrix values_of(const Matrix& quantities) {
  const Index n = quantities.cols();
  Matrix values(1, 4 * n);
  values.leftCols(n) = quantities.bottomRows(1);
  for (Index i = 0; i < n; ++i) {
    const auto all = quantities.col(i);
    values(0, n + i) = all.maxCoeff<Eigen::PropagateNaN>();
    values(0, 2 * n + i) = all.minCoeff<Eigen::PropagateNaN>();
    values(0, 3 * n + i) = all.mean();
  }
  return values;
}

}  // namespace

std::function<double(const Episode&)> episode_formula(const Robot& robot, const Formula& formula) {
  const std::vector<Formula> quantities = quantities_of(robot);
  return [of_states = program(formulas_of(robot, Of::states), quantities),
          of_episode = program(formulas_of_episodes(robot, quantities), {formula})](const Episode& episode) {
    return evaluate(of_episode, values_of(evaluate(of_states, episode.true_states)))(0, 0);
  };
}

}  // namespace rehearse::robot_file
