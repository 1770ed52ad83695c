#include "rehearse/robots/pendubot/pendubot.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "rehearse/core/vector_math.hpp"
#include "rehearse/reward/saturating.hpp"
#include "rehearse/scenario/builder.hpp"

#define REHEARSE_EQUATION "rehearse/robots/pendubot/equation.hpp"
#include "rehearse/system/equation_kernel.hpp"

namespace rehearse::robots::pendubot {
namespace {

constexpr double kDt = 0.05;           // s
constexpr Index kHorizon = 50;         // 2.5 s
constexpr double kTorque = 3.5;        // N m
constexpr double kRewardLength = 0.5;  // m, whatever the lengths of the plant or the prior
constexpr double kRewardWidth = 0.5;   // m
constexpr double kSolvedDistance = 0.2;
constexpr double kSolvedTime = 0.5;  // s, at the end
const Vector kPolicyScale{{10, 10, 1, 1, 1, 1}};

/// The parameters in the order of φ.
ParameterSpace parameters(const Physics& p) {
  return ParameterSpace({Parameter::fixed("m1", p.m1, "kg"), Parameter::fixed("m2", p.m2, "kg"),
                         Parameter::fixed("l1", p.l1, "m"), Parameter::fixed("l2", p.l2, "m"),
                         Parameter::fixed("b1", p.b1, "N m s/rad"), Parameter::fixed("b2", p.b2, "N m s/rad")});
}

/// ‖tip − (0, 1)‖² with tip = (−l (sin θ1 + sin θ2), l (cos θ1 + cos θ2)).
void squared_tip_distance(const ConstMatrixView& X, VectorView d2) {
  thread_local Matrix trig;
  trig.resize(X.rows(), 4);
  for (Index i = 0; i < 2; ++i)
    vector_sin_cos(X.col(2 + i).data(), trig.col(2 * i).data(), trig.col(2 * i + 1).data(), X.rows());
  const auto x = kRewardLength * (trig.col(0) + trig.col(2)).array();
  const auto y = 1.0 - kRewardLength * (trig.col(1) + trig.col(3)).array();
  d2 = x.square() + y.square();
}

reward::ClosedForm closed_form() {
  const double l = kRewardLength;
  return {.goal = Vector{{0, 0, 1, 0, 1, 0}},
          .distances = Matrix{{0, 0, l, 0, l, 0}, {0, 0, 0, l, 0, l}} / kRewardWidth};
}

Eigen::Vector2d tip(const ConstVectorView& state) {
  return kRewardLength *
         Eigen::Vector2d{-std::sin(state(2)) - std::sin(state(3)), std::cos(state(2)) + std::cos(state(3))};
}

constexpr Index kDescribedTimes = 3;  // equally spaced, the last at the end

std::vector<std::string> descriptor_names() {
  std::vector<std::string> names;
  for (Index i = 1; i <= kDescribedTimes; ++i)
    for (const char* axis : {"x", "y"})
      names.push_back(
          fmt::format("tip {} at {:g} s [m]", axis, static_cast<double>(kHorizon * i / kDescribedTimes) * kDt));
  return names;
}

/// Tip positions (x, y) at these times.
Vector tip_descriptor(const Episode& episode) {
  Vector descriptor(2 * kDescribedTimes);
  for (Index i = 0; i < kDescribedTimes; ++i)
    descriptor.segment<2>(2 * i) =
        tip(episode.true_states.row(episode.steps() * (i + 1) / kDescribedTimes).transpose());
  return descriptor;
}

Task make_task(const Options& options) {
  Task task;
  task.states = {{"dtheta1", "rad/s"},
                 {"dtheta2", "rad/s"},
                 {"theta1", "rad", StateKind::angle, "dtheta1"},
                 {"theta2", "rad", StateKind::angle, "dtheta2", "theta1"}};
  task.actions = {{"u", "N m", {-kTorque, kTorque}}};
  task.start_mean = Vector{{0, 0, std::numbers::pi, std::numbers::pi}};
  task.start_std = Vector::Constant(4, options.ode.start_noise);
  task.dt_s = kDt;
  task.horizon = kHorizon;
  task.reward = reward::saturating(squared_tip_distance, kRewardWidth, closed_form());
  task.initial_reward = scenario::initial_reward(squared_tip_distance, options.ode);
  task.solved = scenario::holds_at_the_end(task, kSolvedTime, each_state([](const ConstVectorView& state) {
                                             return (tip(state) - Eigen::Vector2d{0, 1}).norm() <= kSolvedDistance;
                                           }));
  task.descriptor = tip_descriptor;
  task.descriptor_bounds = std::vector<Interval>(2 * kDescribedTimes, {-2 * kRewardLength, 2 * kRewardLength});
  task.descriptor_names = descriptor_names();
  return task;
}

scenario::LineDrawing drawing(double l1, double l2) {
  const auto lines = [=](const ConstVectorView& state) {
    const scenario::Point elbow = l1 * scenario::Point{-std::sin(state(2)), std::cos(state(2))};
    const scenario::Point end = elbow + l2 * scenario::Point{-std::sin(state(3)), std::cos(state(3))};
    return std::vector<scenario::Line>{{{0, 0}, elbow}, {elbow, end}};
  };
  return {.bodies = {{"link 1", 0.05}, {"link 2", 0.05}}, .goal = {{0, 2 * kRewardLength}}, .lines = lines};
}

/// Chatzilygeroudis 2018, Table I.
std::vector<scenario::Guess> guesses(Interval box) {
  const auto guess = [box](const char* name, const Physics& physics) {
    return scenario::Guess{name, parameters(physics).tunable_in(box, {"m1", "m2", "l1", "l2"})};
  };
  return {guess("useful", {.m1 = 0.65, .l2 = 0.4}), guess("tunable", {.m2 = 0.75}), guess("misleading", {.l2 = 0.25}),
          guess("partial", {.m1 = 0.65, .m2 = 0.35, .b1 = 0, .b2 = 0})};
}

}  // namespace

void Physics::fields(FieldVisitor& v) {
  v.number("m1", m1, "mass of the first link [kg]", above(0));
  v.number("m2", m2, "mass of the second link [kg]", above(0));
  v.number("l1", l1, "length of the first link [m]", above(0));
  v.number("l2", l2, "length of the second link [m]", above(0));
  v.number("b1", b1, "friction of the first joint [N m s/rad]", at_least(0));
  v.number("b2", b2, "friction of the second joint [N m s/rad]", at_least(0));
}

void Options::fields(FieldVisitor& v) {
  v.group("plant", plant);
  v.publish("box_low", published(0, kAuthors));
  v.publish("box_high", published(1, kAuthors));
  v.publish("policy_gain", published(1));
  ode.fields(v);
}

system::OdeKernel kernel() { return system::equation_kernel(); }

scenario::Scenario make(const Options& options) {
  return scenario::make_ode_scenario({.name = "pendubot",
                                      .task = make_task(options),
                                      .kernel = kernel(),
                                      .plant = parameters(options.plant),
                                      .guesses = guesses(options.ode.box()),
                                      .policy_scale = kPolicyScale,
                                      .drawing = drawing(options.plant.l1, options.plant.l2)},
                                     options.ode);
}

std::unique_ptr<scenario::ScenarioBuilder> builder() {
  return scenario::make_builder(
      "swing up two links by a torque on the first joint (50 steps of 0.05 s); solved: the tip within 0.2 m of its "
      "goal for the last 0.5 s",
      make);
}

}  // namespace rehearse::robots::pendubot
