#include "rehearse/robot_file/task.hpp"

#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "rehearse/robot_file/closed_form.hpp"
#include "rehearse/robot_file/episode_formula.hpp"
#include "rehearse/robot_file/formulas.hpp"
#include "rehearse/robot_file/table.hpp"
#include "rehearse/scenario/ode_scenario.hpp"

namespace rehearse::robot_file {
namespace {

using expression::Formulas, expression::Node, expression::Pace, expression::Program;

class Checker {
 public:
  Checker(const Robot& robot, files::FileViolations& violations) : robot_(robot), violations_(violations) {}

  void check() {
    Formulas of_costs = inputs_of(robot_, Of::costs);  // no formula may use more
    check_definitions(of_costs, robot_.definitions);
    const Functions& functions = robot_.functions;
    Formulas of_steps = good_ ? formulas_of(robot_, Of::steps) : Formulas();
    if (!is_of_program(robot_.reward.formula, functions.of_steps))
      compile(of_steps, "reward.formula", robot_.reward.formula);
    compile(of_costs, "reward.cost", robot_.reward.cost);
    for (const LimitFormula& limit : robot_.limits)
      if (!is_of_program(limit.keep, functions.limits))
        compile(of_costs, "limit.keep", limit.keep, &Formulas::compile_condition);
    check_episode(robot_.reward.episode);
    Formulas of_states = good_ ? formulas_of(robot_, Of::states) : Formulas();
    for (const Formula& distance : robot_.reward.distance) compile(of_states, "reward.distance", distance);
    check_condition(of_states, "success.when", robot_.success.when, functions.of_states);
    check_condition(of_states, "ended", robot_.ended, functions.of_states);
    for (const Body& body : robot_.bodies)
      for (const Formula* formula : {&body.from[0], &body.from[1], &body.to[0], &body.to[1]})
        compile(of_states, fmt::format("body {}", body.name), *formula);
    for (const Dynamics& dynamics : robot_.dynamics)
      if (const auto* equations = std::get_if<Equations>(&dynamics.source)) check_equations(dynamics, *equations);
  }

 private:
  template <class Work>
  bool named(Index line, Work work, const std::string& what = "") {
    try {
      work();
      return true;
    } catch (const InvalidInput& error) {
      violations_.add(line, what.empty() ? error.what() : fmt::format("{}: {}", what, error.what()));
      return false;
    }
  }

  void compile(Formulas& formulas, const std::string& what, const Formula& formula,
               Node (Formulas::*as)(const std::string&) = &Formulas::compile) {
    if (!formula.empty() && good_)
      named(
          formula.line, [&] { (formulas.*as)(formula.text); }, what);
  }

  /// True of a function of the program, which must be there, and of no formula.
  template <class Function>
  bool is_of_program(const Formula& formula, const std::map<std::string, Function>& functions) {
    if (formula.is_function())
      require_function(robot_.functions, functions, formula.function(), formula.line, violations_);
    return formula.is_function();
  }

  template <class Function>
  void check_condition(Formulas& formulas, const std::string& what, const Formula& formula,
                       const std::map<std::string, Function>& functions) {
    if (!is_of_program(formula, functions)) compile(formulas, what, formula, &Formulas::compile_condition);
  }

  void check_episode(const Formula& episode) {
    if (!is_of_program(episode, robot_.functions.of_episodes) && !episode.empty() && good_)
      named(
          episode.line, [&] { episode_formula(robot_, episode); }, "reward.episode");
  }

  /// Formulas that use a wrong definition are not compiled: the definition is to blame.
  void check_definitions(Formulas& formulas, const Definitions& definitions) {
    good_ = true;
    for (const auto& [name, formula] : definitions)
      good_ &= named(formula.line, [&, &name = name, &formula = formula] { formulas.define(name, formula.text); });
    for (const auto& [name, formula] : definitions)
      if (good_)
        good_ &= named(
            formula.line, [&, &name = name] { formulas.named(name); }, name);
  }

  void check_equations(const Dynamics& dynamics, const Equations& equations) {
    Formulas formulas;
    formulas.elsewhere("time", kOnlyOfCosts);
    for (const Parameter& parameter : dynamics.parameters)
      named(dynamics.line, [&] { formulas.input(parameter.name, Pace::call); });
    for (const std::string& name : robot_.action_names())
      named(dynamics.line, [&] { formulas.input(name, Pace::block); });
    for (const std::string& name : robot_.state_names())
      named(dynamics.line, [&] { formulas.input(name, Pace::always); });
    check_definitions(formulas, equations.definitions);
    for (std::size_t i = 0; i < equations.rates.size(); ++i)
      compile(formulas, fmt::format("rate.{}", robot_.state_names()[i]), equations.rates[i]);
  }

  const Robot& robot_;
  files::FileViolations& violations_;
  bool good_ = true;  // the definitions that formulas use
};

/// A formula of the state that a step reaches and the action that took it there.
Reward of_steps(const Robot& robot, const Formula& formula) {
  if (formula.is_function()) return function_of(robot.functions.of_steps, formula.function());
  return [program = program(formulas_of(robot, Of::steps), {formula})](
             const ConstMatrixView&, const ConstMatrixView& U, const ConstMatrixView& X_next, VectorView values) {
    evaluate_one(program, X_next, U, values);
  };
}

Reward reward_of(const Robot& robot) {
  if (!robot.reward.distance.empty()) {
    const auto squared = [program = program(formulas_of(robot, Of::states), robot.reward.distance)](
                             const ConstMatrixView& X_next, VectorView d2) {
      thread_local Matrix distances;
      distances.resize(X_next.rows(), program.outputs());
      evaluate(program, X_next, Matrix(), distances);
      d2 = distances.rowwise().squaredNorm();
    };
    return reward::saturating(squared, robot.reward.width, closed_form(robot));
  }
  if (auto form = closed_form(robot)) {
    const auto squared = [program = *exponent_of(robot, robot.reward.formula)](const ConstMatrixView& X_next,
                                                                               VectorView d2) {
      evaluate_one(program, X_next, Matrix(), d2);
      d2 *= -2;
    };
    return reward::saturating(squared, 1, std::move(form));
  }
  return of_steps(robot, robot.reward.formula);
}

/// A formula of a cost or a limit.
StepCost cost_of(const Robot& robot, const Formula& formula) {
  return [program = program(formulas_of(robot, Of::costs), {formula})](const Steps& steps, VectorView values) {
    thread_local Matrix more;
    more.resize(steps.U.rows(), 2 * steps.U.cols() + 1);
    more << steps.U, steps.U_before, Vector::Constant(steps.U.rows(), steps.time_s);
    evaluate_one(program, steps.X_next, more, values);
  };
}

StepCondition limit_of(const Robot& robot, const Formula& keep) {
  return keep.is_function() ? function_of(robot.functions.limits, keep.function()) : cost_of(robot, keep);
}

StateCondition of_states(const Robot& robot, const Formula& formula) {
  if (formula.is_function()) return function_of(robot.functions.of_states, formula.function());
  return [program = program(formulas_of(robot, Of::states), {formula})](const ConstMatrixView& X, VectorView holds) {
    evaluate_one(program, X, Matrix(), holds);
  };
}

}  // namespace

void check_formulas(const Robot& robot, files::FileViolations& violations) { Checker(robot, violations).check(); }

Task make_task(const Robot& robot) {
  Task task;
  const auto dx = static_cast<Index>(robot.states.size());
  task.start_mean = task.start_std = Vector(dx);
  for (Index i = 0; i < dx; ++i) {
    const State& state = robot.states[static_cast<std::size_t>(i)];
    task.states.push_back(state.variable);
    task.start_mean(i) = state.start;
    task.start_std(i) = state.start_noise;
  }
  task.actions = robot.actions;
  task.dt_s = robot.dt_s;
  task.horizon = robot.horizon;
  if (!robot.functions.of_steps.empty() || !robot.functions.of_episodes.empty() || !robot.functions.limits.empty() ||
      !robot.functions.of_states.empty())
    task.rows_at_once = robot.functions.rows_at_once;
  task.reward = reward_of(robot);
  task.reward_floor = robot.reward.floor;
  if (const Formula& episode = robot.reward.episode; !episode.empty())
    task.episode_reward = episode.is_function() ? function_of(robot.functions.of_episodes, episode.function())
                                                : episode_formula(robot, episode);
  if (!robot.reward.cost.empty()) task.cost = cost_of(robot, robot.reward.cost);
  if (!robot.success.when.empty())
    task.solved = scenario::holds_at_the_end(task, robot.success.last_s, of_states(robot, robot.success.when));
  if (!robot.ended.empty()) task.ended = of_states(robot, robot.ended);
  for (const LimitFormula& limit : robot.limits)
    task.limits.push_back({limit.name, limit.keep.text, limit_of(robot, limit.keep), limit.risk});
  return with_memory(std::move(task));
}

std::optional<scenario::Drawing> make_drawing(const Robot& robot) {
  if (robot.bodies.empty()) return {};
  scenario::LineDrawing drawing;
  std::vector<Formula> ends;
  for (const Body& body : robot.bodies) {
    drawing.bodies.push_back({body.name, body.width_m});
    ends.insert(ends.end(), {body.from[0], body.from[1], body.to[0], body.to[1]});
  }
  drawing.lines = [program = program(formulas_of(robot, Of::states), ends),
                   bodies = robot.bodies.size()](const ConstVectorView& state) {
    const Vector at = evaluate(program, Matrix(state.transpose())).row(0);
    std::vector<scenario::Line> lines;
    for (std::size_t b = 0; b < bodies; ++b) {
      const auto end = at.segment<4>(4 * static_cast<Index>(b));
      lines.push_back({{end(0), end(1)}, {end(2), end(3)}});
    }
    return lines;
  };
  return drawing;
}

}  // namespace rehearse::robot_file
