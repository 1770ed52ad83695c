#include "rehearse/robots/cartpole/cartpole.hpp"

#include <cmath>
#include <numbers>

#include "rehearse/core/angle.hpp"
#include "rehearse/core/vector_math.hpp"
#include "rehearse/reward/saturating.hpp"
#include "rehearse/scenario/builder.hpp"

#define REHEARSE_EQUATION "rehearse/robots/cartpole/equation.hpp"
#include "rehearse/system/equation_kernel.hpp"

namespace rehearse::robots::cartpole {
namespace {

constexpr double kForce = 10;            // N
constexpr double kRewardLength = 0.5;    // m, whatever the length of the plant or the prior
constexpr double kRewardWidth = 0.25;    // m
constexpr double kAngleWidth = 3;        // rad, of the wide reward
constexpr double kCartWidth = 1;         // m, the same
constexpr double kSolvedDistance = 0.1;  // m, of the cart from the centre
constexpr double kPi = std::numbers::pi;
constexpr double kSolvedAngle = 10 * kPi / 180;
const Vector kPolicyScale{{5, 5, 10, 1, 1}};
constexpr double kSolvedTime = 0.5;  // s, at the end

/// The parameters in the order of φ.
ParameterSpace parameters(const Physics& p) {
  return ParameterSpace({Parameter::fixed("m_pole", p.m_pole, "kg"), Parameter::fixed("m_cart", p.m_cart, "kg"),
                         Parameter::fixed("l", p.l, "m"), Parameter::fixed("b", p.b, "N s/m")});
}

/// The squared distance of the pole's tip from where it is upright at x = 0: x² + 2 x l sin θ + 2 l² + 2 l² cos θ.
void squared_tip_distance(const ConstMatrixView& X, VectorView d2) {
  thread_local Matrix trig;
  trig.resize(X.rows(), 2);
  vector_sin_cos(X.col(3).data(), trig.col(0).data(), trig.col(1).data(), X.rows());
  const auto x = X.col(0).array();
  d2 =
      x * (x + 2 * kRewardLength * trig.col(0).array()) + 2 * kRewardLength * kRewardLength * (1 + trig.col(1).array());
}

/// exp(−(Δθ/3)² − x²), Δθ from the upright (Amadio 2022): it has a slope far from the goal, too.
Reward wide_reward() {
  const auto squared_distance = [](const ConstMatrixView& X, VectorView d2) {
    const auto from_hanging = X.col(3).array().unaryExpr([](double angle) { return shorter_way(angle); });
    d2 = ((kPi - from_hanging.abs()) / kAngleWidth).square() + (X.col(0).array() / kCartWidth).square();
  };
  return reward::saturating(squared_distance, std::numbers::sqrt2 / 2);
}

Reward shaped(Reward reward, double share) {
  return [reward = std::move(reward), wide = wide_reward(), share](const ConstMatrixView& X, const ConstMatrixView& U,
                                                                   const ConstMatrixView& X_next, VectorView rewards) {
    thread_local Vector wide_rewards;
    wide_rewards.resize(rewards.size());
    wide(X, U, X_next, wide_rewards);
    reward(X, U, X_next, rewards);
    rewards += share * (wide_rewards - rewards);
  };
}

/// The same as squared_tip_distance: the tip is at (x + l sin θ, −l cos θ), the goal at (0, l).
reward::ClosedForm closed_form() {
  const double l = kRewardLength;
  return {.goal = Vector{{0, 0, 0, -1, 0}}, .distances = Matrix{{1, 0, 0, 0, l}, {0, 0, 0, l, 0}} / kRewardWidth};
}

Task make_task(const Options& options) {
  Task task;
  task.states = {{"x", "m", StateKind::plain, "dx"},
                 {"dx", "m/s"},
                 {"dtheta", "rad/s"},
                 {"theta", "rad", StateKind::angle, "dtheta"}};
  task.actions = {{"u", "N", {-kForce, kForce}}};
  task.start_mean = Vector::Zero(4);
  task.start_std = Vector::Constant(4, options.ode.start_noise);
  task.dt_s = options.dt_s;
  task.horizon = options.horizon;
  task.reward = reward::saturating(squared_tip_distance, kRewardWidth, closed_form());
  if (options.shaping > 0) task.reward = shaped(std::move(task.reward), options.shaping);
  task.initial_reward = scenario::initial_reward(squared_tip_distance, options.ode);
  task.solved = scenario::holds_at_the_end(task, kSolvedTime, each_state([](const ConstVectorView& state) {
                                             return std::abs(state(0)) <= kSolvedDistance &&
                                                    -std::cos(state(3)) >= std::cos(kSolvedAngle);
                                           }));
  if (options.track > 0) {
    task.limits = {scenario::limit_within(task.states[0], 0, options.track, options.risk)};
    task.limits.front().name = "track";
  }
  return task;
}

scenario::LineDrawing drawing(double l) {
  const auto lines = [l](const ConstVectorView& state) {
    const scenario::Point hinge{state(0), 0}, half_cart{0.1, 0};
    const scenario::Point tip = hinge + l * scenario::Point{std::sin(state(3)), -std::cos(state(3))};
    return std::vector<scenario::Line>{{hinge - half_cart, hinge + half_cart}, {hinge, tip}};
  };
  return {.bodies = {{"cart", 0.1}, {"pole", 0.03}}, .goal = {{0, kRewardLength}}, .lines = lines};
}

/// Ours, in the manner of Chatzilygeroudis 2018, Table I; b is never tunable.
std::vector<scenario::Guess> guesses(Interval box) {
  const auto guess = [box](const char* name, const Physics& physics) {
    return scenario::Guess{name, parameters(physics).tunable_in(box, {"m_pole", "m_cart", "l"})};
  };
  return {guess("useful", {.m_pole = 0.65, .l = 0.4}), guess("tunable", {.m_cart = 0.75}),
          guess("misleading", {.m_pole = 0.75, .m_cart = 0.75, .l = 0.25}),
          guess("partial", {.m_pole = 0.65, .m_cart = 0.35, .b = 1})};
}

}  // namespace

void Physics::fields(FieldVisitor& v) {
  v.number("m_pole", m_pole, "mass of the pole [kg]", above(0));
  v.number("m_cart", m_cart, "mass of the cart [kg]", above(0));
  v.number("l", l, "length of the pole [m]", above(0));
  v.number("b", b, "friction between cart and ground [N s/m]", at_least(0));
}

void Options::fields(FieldVisitor& v) {
  v.group("plant", plant);
  v.number("dt_s", dt_s, "control step [s]", above(0));
  v.integer("horizon", horizon, "steps of an episode", between(1, 1e6));
  v.number("shaping", shaping, "weight of MC-PILCO's wide shaping reward; PILCO learners and PI-REM need 0",
           between(0, 1));
  v.number("track", track, "half the length of the track, a limit of the cart's position; 0: it has no ends [m]",
           at_least(0));
  v.number("risk", risk, "largest probability that an episode leaves the track", between(0.001, 0.999));
  ode.fields(v);
}

system::OdeKernel kernel() { return system::equation_kernel(); }

scenario::Scenario make(const Options& options) {
  return scenario::make_ode_scenario({.name = "cartpole",
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
      "swing up and balance a pole on a cart (40 steps of 0.1 s); solved: upright and in the middle for the last 0.5 s",
      make);
}

}  // namespace rehearse::robots::cartpole
