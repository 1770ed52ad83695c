#include "rehearse/robots/pendulum/pendulum.hpp"

#include <cmath>
#include <numbers>

#include "rehearse/core/vector_math.hpp"
#include "rehearse/reward/saturating.hpp"
#include "rehearse/scenario/builder.hpp"

#define REHEARSE_EQUATION "rehearse/robots/pendulum/equation.hpp"
#include "rehearse/system/equation_kernel.hpp"

namespace rehearse::robots::pendulum {
namespace {

constexpr double kDt = 0.1;  // s
constexpr Index kHorizon = 40;
constexpr double kTorque = 2.5;       // N m
constexpr double kRewardWidth = 0.5;  // of a pendulum of length 1
const Vector kPolicyScale{{10, 1, 1}};
constexpr double kSolvedAngle = 10 * std::numbers::pi / 180;
constexpr double kSolvedTime = 0.5;  // s, at the end

/// The parameters in the order of φ.
ParameterSpace parameters(const Physics& p) {
  return ParameterSpace(
      {Parameter::fixed("m", p.m, "kg"), Parameter::fixed("l", p.l, "m"), Parameter::fixed("b", p.b, "N m s/rad")});
}

/// (cos θ + 1)² + sin² θ = 2 + 2 cos θ
void squared_distance(const ConstMatrixView& X, VectorView d2) {
  thread_local Vector sine;
  sine.resize(X.rows());
  vector_sin_cos(X.col(1).data(), sine.data(), d2.data(), X.rows());
  d2 = 2 + 2 * d2.array();
}

reward::ClosedForm closed_form() {
  return {.goal = Vector{{0, -1, 0}}, .distances = Matrix{{0, 1, 0}, {0, 0, 1}} / kRewardWidth};
}

Task make_task(const Options& options) {
  Task task;
  task.states = {{"dtheta", "rad/s"}, {"theta", "rad", StateKind::angle, "dtheta"}};
  task.actions = {{"u", "N m", {-kTorque, kTorque}}};
  task.start_mean = Vector::Zero(2);
  task.start_std = Vector::Constant(2, options.ode.start_noise);
  task.dt_s = kDt;
  task.horizon = kHorizon;
  task.reward = reward::saturating(squared_distance, kRewardWidth, closed_form());
  task.initial_reward = scenario::initial_reward(squared_distance, options.ode);
  task.solved = scenario::holds_at_the_end(task, kSolvedTime, each_state([](const ConstVectorView& state) {
                                             return -std::cos(state(1)) >= std::cos(kSolvedAngle);
                                           }));
  if (options.speed_limit > 0)
    task.limits = {scenario::limit_within(task.states[0], 0, options.speed_limit, options.risk)};
  return task;
}

scenario::LineDrawing drawing(double l) {
  const auto lines = [l](const ConstVectorView& state) {
    const scenario::Point tip = l * scenario::Point{std::sin(state(1)), -std::cos(state(1))};
    return std::vector<scenario::Line>{{{0, 0}, tip}};
  };
  return {.bodies = {{"pendulum", 0.06}}, .goal = {{0, l}}, .lines = lines};
}

/// Ours, in the manner of Chatzilygeroudis 2018, Table I; b is never tunable.
std::vector<scenario::Guess> guesses(Interval box) {
  const auto guess = [box](const char* name, const Physics& physics) {
    return scenario::Guess{name, parameters(physics).tunable_in(box, {"m", "l"})};
  };
  return {guess("useful", {.m = 1.3, .l = 0.8}), guess("tunable", {.m = 1.5}), guess("misleading", {.l = 0.5}),
          guess("partial", {.m = 0.7, .b = 0.3})};
}

}  // namespace

void Physics::fields(FieldVisitor& v) {
  v.number("m", m, "mass of the pendulum [kg]", above(0));
  v.number("l", l, "length of the pendulum [m]", above(0));
  v.number("b", b, "friction of the axis [N m s/rad]", at_least(0));
}

void Options::fields(FieldVisitor& v) {
  v.group("plant", plant);
  v.number("speed_limit", speed_limit, "limit of the pendulum's speed; 0: there is none [rad/s]", at_least(0));
  v.number("risk", risk, "largest probability that an episode exceeds the speed limit", between(0.001, 0.999));
  ode.fields(v);
}

system::OdeKernel kernel() { return system::equation_kernel(); }

scenario::Scenario make(const Options& options) {
  return scenario::make_ode_scenario({.name = "pendulum",
                                      .task = make_task(options),
                                      .kernel = kernel(),
                                      .plant = parameters(options.plant),
                                      .guesses = guesses(options.ode.box()),
                                      .policy_scale = kPolicyScale,
                                      .drawing = drawing(options.plant.l)},
                                     options.ode);
}

std::unique_ptr<scenario::ScenarioBuilder> builder() {
  return scenario::make_builder(
      "swing up a pendulum whose motor is too weak to lift it (40 steps of 0.1 s); solved: upright for the last 0.5 s",
      make);
}

}  // namespace rehearse::robots::pendulum
