#include "rehearse/robot_file/closed_form.hpp"

#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "rehearse/core/errors.hpp"
#include "rehearse/robot_file/formulas.hpp"

namespace rehearse::robot_file {
namespace {

using expression::Formulas, expression::Node, expression::Op, expression::Pace, expression::Program;

constexpr double kRounding = 1e-9;      // of numbers that should be the same
constexpr double kNoCurvature = 1e-13;  // of the largest
constexpr double kReward = 1e-6;        // error of rewards

/// Formulas of states with sine and cosine of each angle as inputs of their own, behind the states.
Formulas formulas_of_features(const Robot& robot) {
  Formulas formulas = formulas_of(robot, Of::states);
  for (const State& state : robot.states) {
    if (state.variable.kind != StateKind::angle) continue;
    const Node sine = formulas.builder().input(Pace::always), cosine = formulas.builder().input(Pace::always);
    formulas.builder().known_trigonometry(formulas.named(state.variable.name), sine, cosine);
  }
  return formulas;
}

/// The input of formulas_of_features that each feature is.
std::vector<Index> inputs_of_features(const Robot& robot) {
  std::vector<Index> inputs;
  const Index states = robot.actuators().states();
  Index sine = states;
  for (Index state = 0; state < states; ++state) {
    const auto own = static_cast<std::size_t>(state);
    const StateKind kind = own < robot.states.size() ? robot.states[own].variable.kind : StateKind::plain;
    if (kind == StateKind::plain) inputs.push_back(state);
    if (kind == StateKind::angle) {
      inputs.insert(inputs.end(), {sine + 1, sine});  // features have the cosine first
      sine += 2;
    }
  }
  return inputs;
}

std::optional<Program> exponent_in(Formulas formulas, const Formula& formula) try {
  const Node exponent = formulas.builder().argument_of(Op::exponential, formulas.compile(formula.text));
  if (exponent == expression::TapeBuilder::kNone) return {};
  return Program(formulas, {exponent});
} catch (const InvalidInput&) {  // it needs an action
  return {};
}

struct Linear {
  Matrix slopes;   // outputs × inputs
  Vector at_zero;  // one an output
};

/// Empty where the program is not linear in its inputs.
std::optional<Linear> linear_in_inputs(const Program& program) {
  if (program.degree() > 1) return {};
  const Index inputs = program.inputs();
  Matrix X = Matrix::Zero(1 + inputs, inputs);
  X.bottomRows(inputs).setIdentity();
  const Matrix d = evaluate(program, X);
  if (!d.allFinite()) return {};
  return Linear{(d.bottomRows(inputs).rowwise() - d.row(0)).transpose(), d.row(0)};
}

/// zᵀ curvature z − 2 slope z + at_zero of the inputs z.
struct Quadratic {
  Matrix curvature;
  Vector slope;
  double at_zero;
};

/// −2 times the first output; empty where it is no quadratic function of the inputs.
std::optional<Quadratic> quadratic_in_inputs(const Program& program) {
  if (program.degree() > 2) return {};
  const Index n = program.inputs();
  const Matrix one = Matrix::Identity(n, n);
  const auto at = [&](const Matrix& X) -> Vector { return -2 * evaluate(program, X).col(0); };
  const double zero = at(Matrix::Zero(1, n))(0);
  const Vector plus = at(one), minus = at(-one);
  Quadratic result{Matrix(n, n), (minus - plus) / 4, zero};
  for (Index i = 0; i < n; ++i) {
    // Without an error where the input i plays no part
    const Vector both = at(one.rowwise() + one.row(i));
    result.curvature.col(i) = ((both.array() - plus(i)) - (plus.array() - zero)) / 2;
    result.curvature(i, i) = (plus(i) - zero) / 2 + (minus(i) - zero) / 2;
  }
  if (!result.curvature.allFinite() || !result.slope.allFinite() || !std::isfinite(zero)) return {};
  return result;
}

/// The columns that are features, in their order; empty where another input (an angle as it is, a state that is no
/// feature) plays a part, whose column is not zero.
std::optional<Matrix> of_features_alone(const Matrix& of_inputs, const std::vector<Index>& features) {
  Matrix rest = of_inputs;
  for (const Index input : features) rest.col(input).setZero();
  if (rest.cwiseAbs().maxCoeff() > 0) return {};
  return of_inputs(Eigen::all, features);
}

std::optional<reward::ClosedForm> form_of_distances(const Robot& robot, const std::vector<Index>& features) {
  const auto linear = linear_in_inputs(program(formulas_of_features(robot), robot.reward.distance));
  const auto slopes = linear ? of_features_alone(linear->slopes, features) : std::nullopt;
  if (!slopes) return {};
  reward::ClosedForm form;
  form.distances = *slopes / robot.reward.width;
  const Vector wanted = -linear->at_zero / robot.reward.width;
  form.goal = form.distances.completeOrthogonalDecomposition().solve(wanted);
  if ((form.distances * form.goal - wanted).norm() > kRounding * (1 + wanted.norm())) return {};
  return form;
}

std::optional<reward::ClosedForm> form_of_formula(const Robot& robot, const std::vector<Index>& features) {
  const auto exponent = exponent_in(formulas_of_features(robot), robot.reward.formula);
  const auto quadratic = exponent ? quadratic_in_inputs(*exponent) : std::nullopt;
  if (!quadratic) return {};
  Matrix all(quadratic->slope.size() + 1, quadratic->slope.size());
  all << quadratic->curvature, quadratic->slope.transpose();
  const auto own = of_features_alone(all, features);
  if (!own) return {};
  const Eigen::SelfAdjointEigenSolver<Matrix> solver((*own)(features, Eigen::all));
  const Vector& values = solver.eigenvalues();  // ascending
  const Index n = values.size();
  const double least = kNoCurvature * values(n - 1);
  if (!(values(n - 1) > 0) || values(0) < -least) return {};
  const Index rank = (values.array() > least).count();
  const Matrix directions = solver.eigenvectors().rightCols(rank);
  const Vector curvatures = values.tail(rank), slope = own->bottomRows(1).transpose();
  reward::ClosedForm form;
  form.distances = curvatures.cwiseSqrt().asDiagonal() * directions.transpose();
  form.goal = directions * curvatures.cwiseInverse().asDiagonal() * directions.transpose() * slope;
  const bool has_goal = (directions * directions.transpose() * slope - slope).norm() <= kRounding * (1 + slope.norm());
  if (!has_goal || std::abs(quadratic->at_zero - slope.dot(form.goal)) > kReward) return {};  // 1 at the goal
  return form;
}

}  // namespace

std::optional<reward::ClosedForm> closed_form(const Robot& robot) {
  const std::vector<Index> features = inputs_of_features(robot);
  if (!robot.reward.distance.empty()) return form_of_distances(robot, features);
  if (robot.reward.formula.is_function()) return {};
  return form_of_formula(robot, features);
}

std::optional<Program> exponent_of(const Robot& robot, const Formula& formula) {
  return exponent_in(formulas_of(robot, Of::states), formula);
}

}  // namespace rehearse::robot_file
