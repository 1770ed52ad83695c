#include "rehearse/robot_file/task.hpp"

#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "rehearse/expression/program.hpp"

namespace rehearse::robot_file {
namespace {

using expression::Formulas, expression::Node, expression::Pace, expression::Program;

/// Formulas of the task: their inputs are the states, then the actions.
Formulas task_formulas(const Robot& robot) {
  Formulas formulas;
  for (const std::string& name : robot.state_names()) formulas.input(name, Pace::always);
  for (const std::string& name : robot.action_names()) formulas.input(name, Pace::always);
  for (const auto& [name, formula] : robot.definitions) formulas.define(name, formula.text);
  return formulas;
}

Program program(const Robot& robot, const std::vector<Formula>& outputs) {
  Formulas formulas = task_formulas(robot);
  std::vector<Node> nodes;
  for (const Formula& output : outputs) nodes.push_back(formulas.compile(output.text));
  return {formulas, nodes};
}

/// Of states and actions (rows × any); U may be empty where no formula needs it, then actions are 0.
Matrix evaluate(const Program& program, const ConstMatrixView& X, const ConstMatrixView& U) {
  std::vector<const double*> columns;
  for (Index i = 0; i < X.cols(); ++i) columns.push_back(X.col(i).data());
  for (Index i = 0; i < U.cols(); ++i) columns.push_back(U.col(i).data());
  Matrix results(X.rows(), program.outputs());
  program.run(columns, results);
  return results;
}

/// Of one state, without actions.
Vector evaluate(const Program& program, const ConstVectorView& x, Index actions) {
  const Matrix X = x.transpose(), U = Matrix::Zero(1, actions);
  return evaluate(program, X, U).row(0);
}

class Checker {
 public:
  Checker(const Robot& robot, files::FileViolations& violations) : robot_(robot), violations_(violations) {}

  void check() {
    Formulas formulas;
    for (const std::string& name : robot_.state_names()) formulas.input(name, Pace::always);
    for (const std::string& name : robot_.action_names()) formulas.input(name, Pace::always);
    check_definitions(formulas, robot_.definitions);
    for (const Formula& distance : robot_.reward.distance) compile(formulas, "reward.distance", distance);
    compile(formulas, "reward.formula", robot_.reward.formula);
    compile(formulas, "success.when", robot_.success.when);
    compile(formulas, "ended", robot_.ended);
    for (const Body& body : robot_.bodies)
      for (const Formula* formula : {&body.from[0], &body.from[1], &body.to[0], &body.to[1]})
        compile(formulas, fmt::format("body {}", body.name), *formula);
    for (const Dynamics& dynamics : robot_.dynamics) check_dynamics(dynamics);
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

  void compile(Formulas& formulas, const std::string& what, const Formula& formula) {
    if (!formula.empty() && good_)
      named(
          formula.line, [&] { formulas.compile(formula.text); }, what);
  }

  /// What uses a wrong definition is not to blame.
  void check_definitions(Formulas& formulas, const Definitions& definitions) {
    good_ = true;
    for (const auto& [name, formula] : definitions)
      good_ &= named(formula.line, [&, &name = name, &formula = formula] { formulas.define(name, formula.text); });
    for (const auto& [name, formula] : definitions)
      if (good_)
        good_ &= named(
            formula.line, [&, &name = name] { formulas.named(name); }, name);
  }

  void check_dynamics(const Dynamics& dynamics) {
    Formulas formulas;
    for (const Parameter& parameter : dynamics.parameters)
      named(dynamics.line, [&] { formulas.input(parameter.name, Pace::call); });
    for (const std::string& name : robot_.action_names())
      named(dynamics.line, [&] { formulas.input(name, Pace::block); });
    for (const std::string& name : robot_.state_names())
      named(dynamics.line, [&] { formulas.input(name, Pace::always); });
    check_definitions(formulas, dynamics.definitions);
    for (std::size_t i = 0; i < dynamics.rates.size(); ++i)
      compile(formulas, fmt::format("rate.{}", robot_.state_names()[i]), dynamics.rates[i]);
  }

  const Robot& robot_;
  files::FileViolations& violations_;
  bool good_ = true;  // the definitions that formulas use
};

Reward reward_of(const Robot& robot) {
  if (!robot.reward.distance.empty()) {
    const auto squared = [program = program(robot, robot.reward.distance), actions = robot.actions.size()](
                             const ConstMatrixView& X_next, VectorView d2) {
      d2 = evaluate(program, X_next, Matrix::Zero(X_next.rows(), static_cast<Index>(actions))).rowwise().squaredNorm();
    };
    return reward::saturating(squared, robot.reward.width, closed_form(robot));
  }
  return [program = program(robot, {robot.reward.formula})](const ConstMatrixView&, const ConstMatrixView& U,
                                                            const ConstMatrixView& X_next, VectorView rewards) {
    rewards = evaluate(program, X_next, U).col(0);
  };
}

/// Truth is any number but 0; NaN is none.
bool holds(const Program& condition, const ConstVectorView& x, Index actions) {
  const double value = evaluate(condition, x, actions)(0);
  return value != 0 && !std::isnan(value);
}

std::function<bool(const Episode&)> solved_of(const Robot& robot) {
  if (robot.success.when.empty()) return {};
  const Index horizon = robot.horizon;
  const Index first = std::max<Index>(0, horizon - std::lround(robot.success.last_s / robot.dt_s));
  const auto actions = static_cast<Index>(robot.actions.size());
  return [=, condition = program(robot, {robot.success.when})](const Episode& episode) {
    if (episode.steps() < horizon || episode.ended) return false;
    for (Index t = first; t <= horizon; ++t)
      if (!holds(condition, episode.true_states.row(t).transpose(), actions)) return false;
    return true;
  };
}

}  // namespace

void check_formulas(const Robot& robot, files::FileViolations& violations) { Checker(robot, violations).check(); }

std::optional<reward::ClosedForm> closed_form(const Robot& robot) {
  Formulas formulas = task_formulas(robot);
  const auto dx = static_cast<Index>(robot.states.size()), du = static_cast<Index>(robot.actions.size());
  Task task;
  for (Index i = 0; i < dx; ++i) {
    task.states.push_back(robot.states[static_cast<std::size_t>(i)].variable);
    if (task.states.back().kind != StateKind::angle) continue;
    const Node sine = formulas.builder().input(Pace::always), cosine = formulas.builder().input(Pace::always);
    formulas.builder().known_trigonometry(formulas.named(task.states.back().name), sine, cosine);
  }
  std::vector<Node> nodes;
  for (const Formula& distance : robot.reward.distance) nodes.push_back(formulas.compile(distance.text));
  const Program program(formulas, nodes);

  // Inputs: states, actions, sine and cosine of each angle; which of them are features, in the features' order.
  std::vector<Index> feature;
  for (Index i = 0, a = 0; i < dx; ++i) {
    const StateKind kind = task.states[static_cast<std::size_t>(i)].kind;
    if (kind == StateKind::plain) feature.push_back(i);
    if (kind == StateKind::angle) feature.push_back(dx + du + 2 * a + 1), feature.push_back(dx + du + 2 * a), ++a;
  }
  const Index inputs = program.inputs(), rows = 1 + inputs, probes = 8;
  Matrix X = Matrix::Zero(rows + probes, inputs);
  X.middleRows(1, inputs).setIdentity();
  for (Index i = 0; i < probes; ++i)
    for (Index j = 0; j < inputs; ++j) X(rows + i, j) = std::sin(3.7 * static_cast<double>(i * inputs + j + 1));
  const Matrix d = evaluate(program, X, Matrix(X.rows(), 0));
  const Matrix slopes = (d.middleRows(1, inputs).rowwise() - d.row(0)).transpose();  // distances × inputs
  const Matrix linear = (X.bottomRows(probes) * slopes.transpose()).rowwise() + d.row(0);
  if (!d.allFinite() || !((linear - d.bottomRows(probes)).cwiseAbs().maxCoeff() < 1e-9)) return {};
  reward::ClosedForm form;
  form.distances = Matrix(d.cols(), static_cast<Index>(feature.size()));
  Matrix rest = slopes;
  for (std::size_t f = 0; f < feature.size(); ++f) {
    form.distances.col(static_cast<Index>(f)) = slopes.col(feature[f]) / robot.reward.width;
    rest.col(feature[f]).setZero();
  }
  if (rest.cwiseAbs().maxCoeff() > 0) return {};  // an action, an angle as it is, a state that is no feature
  const Vector wanted = -d.row(0).transpose() / robot.reward.width;
  form.goal = form.distances.completeOrthogonalDecomposition().solve(wanted);
  if ((form.distances * form.goal - wanted).norm() > 1e-9 * (1 + wanted.norm())) return {};
  return form;
}

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
  task.reward = reward_of(robot);
  task.reward_floor = robot.reward.floor;
  task.solved = solved_of(robot);
  if (!robot.ended.empty())
    task.ended = [condition = program(robot, {robot.ended}), actions = task.action_size()](const ConstVectorView& x) {
      return holds(condition, x, actions);
    };
  return task;
}

std::optional<scenario::Drawing> make_drawing(const Robot& robot) {
  if (robot.bodies.empty()) return {};
  scenario::LineDrawing drawing;
  std::vector<Formula> ends;
  for (const Body& body : robot.bodies) {
    drawing.bodies.push_back({body.name, body.width_m});
    ends.insert(ends.end(), {body.from[0], body.from[1], body.to[0], body.to[1]});
  }
  drawing.lines = [program = program(robot, ends), actions = static_cast<Index>(robot.actions.size()),
                   bodies = robot.bodies.size()](const ConstVectorView& state) {
    const Vector at = evaluate(program, state, actions);
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
