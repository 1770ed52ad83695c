#include "rehearse/robots/pendubot/pendubot.hpp"

#include <cmath>
#include <numbers>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/vector_math.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/reward/saturating.hpp"
#include "rehearse/robots/pendubot/kernel.hpp"
#include "rehearse/system/ode.hpp"

namespace rehearse::robots::pendubot {
namespace {

constexpr double kDt = 0.05;           // s
constexpr Index kHorizon = 50;         // 2.5 s
constexpr double kTorque = 3.5;        // N m
constexpr double kRewardLength = 0.5;  // m, whatever the lengths of the plant or the prior
constexpr double kRewardWidth = 0.5;   // m
constexpr double kSolvedDistance = 0.2;
constexpr Index kSolvedFrom = 40;  // states x_40..x_50: the last 0.5 s

Vector to_phi(const Physics& p) { return Vector{{p.m1, p.m2, p.l1, p.l2, p.b1, p.b2}}; }

Constants to_constants(const Vector& phi) { return {phi(0), phi(1), phi(2), phi(3), phi(4), phi(5)}; }

Parameter fixed(std::string name, std::string unit, double value) {
  Parameter parameter;
  parameter.name = std::move(name);
  parameter.unit = std::move(unit);
  parameter.value = value;
  return parameter;
}

ParameterSpace fixed_space(const Physics& p) {
  return ParameterSpace({fixed("m1", "kg", p.m1), fixed("m2", "kg", p.m2), fixed("l1", "m", p.l1),
                         fixed("l2", "m", p.l2), fixed("b1", "N m s/rad", p.b1), fixed("b2", "N m s/rad", p.b2)});
}

/// m1, m2, l1, l2 tunable in the box; b1, b2 never are.
ParameterSpace tunable_space(const Physics& p, Interval box) {
  std::vector<Parameter> parameters = fixed_space(p).all();
  for (std::size_t i = 0; i < 4; ++i) {
    parameters[i].kind = Parameter::Kind::continuous;
    parameters[i].box = box;
  }
  return ParameterSpace(std::move(parameters));
}

class PendubotSimulator final : public system::Simulator {
 public:
  PendubotSimulator(const Physics& physics, double dt_s, Index substeps)
      : parameters_(fixed_space(physics)), dt_s_(dt_s), substeps_(substeps) {}

  const ParameterSpace& parameters() const override { return parameters_; }
  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const override {
    pendubot::change(X.data(), X.outerStride(), U.data(), to_constants(phi), dt_s_, substeps_, dX.data(),
                     dX.outerStride(), X.rows());
  }

 private:
  ParameterSpace parameters_;
  double dt_s_;
  Index substeps_;
};

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

/// The tip is within 0.2 m of the goal at every state of the last 0.5 s.
bool solved(const Episode& episode) {
  if (episode.steps() < kHorizon || episode.ended) return false;
  const Matrix last = episode.true_states.bottomRows(kHorizon - kSolvedFrom + 1);
  Vector d2(last.rows());
  squared_tip_distance(last, d2);
  return (d2.array() <= kSolvedDistance * kSolvedDistance).all();
}

/// Tip positions (x, y) at three equally spaced times, the last at the end.
Vector tip_descriptor(const Episode& episode) {
  Vector descriptor(6);
  for (Index i = 0; i < 3; ++i) {
    const Index t = episode.steps() * (i + 1) / 3;
    const double angle1 = episode.true_states(t, 2), angle2 = episode.true_states(t, 3);
    descriptor(2 * i) = -kRewardLength * (std::sin(angle1) + std::sin(angle2));
    descriptor(2 * i + 1) = kRewardLength * (std::cos(angle1) + std::cos(angle2));
  }
  return descriptor;
}

Task make_task(const Options& options) {
  Task task;
  task.states = {{"dtheta1", "rad/s"},
                 {"dtheta2", "rad/s"},
                 {"theta1", "rad", StateKind::angle},
                 {"theta2", "rad", StateKind::angle}};
  task.actions = {{"u", "N m", {-kTorque, kTorque}}};
  task.start_mean = Vector{{0, 0, std::numbers::pi, std::numbers::pi}};
  task.start_std = Vector::Constant(4, options.start_noise);
  task.dt_s = kDt;
  task.horizon = kHorizon;
  task.reward = reward::saturating(squared_tip_distance, kRewardWidth);
  task.solved = solved;
  task.descriptor = tip_descriptor;
  return task;
}

std::unique_ptr<system::Plant> make_plant(const Options& options, const Task& task) {
  const auto ode = [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    derivative(x.data(), u(0), to_constants(phi), dxdt.data());
  };
  return system::make_ode_plant({.ode = ode,
                                 .phi = to_phi(options.plant),
                                 .dt_s = kDt,
                                 .start_mean = task.start_mean,
                                 .start_std = task.start_std,
                                 .measurement_std = Vector::Constant(4, options.measurement_noise)});
}

struct Guess {
  std::string name;
  Physics physics;
};

/// Chatzilygeroudis 2018, Table I.
std::vector<Guess> guesses() {
  return {{"useful", {.m1 = 0.65, .l2 = 0.4}},
          {"tunable", {.m2 = 0.75}},
          {"misleading", {.l2 = 0.25}},
          {"partial", {.m1 = 0.65, .m2 = 0.35, .b1 = 0, .b2 = 0}}};
}

class Builder final : public scenario::ScenarioBuilder {
 public:
  std::string name() const override { return "pendubot"; }
  std::string summary() const override {
    return "swing up two links by a torque on the first joint (50 steps of 0.05 s)";
  }
  std::vector<std::string> prior_names() const override {
    std::vector<std::string> names;
    for (const Guess& guess : guesses()) names.push_back(guess.name);
    return names;
  }
  void fields(FieldVisitor& v) override { options_.fields(v); }
  scenario::Scenario build() const override { return make(options_); }

 private:
  Options options_;
};

}  // namespace

void Physics::fields(FieldVisitor& v) {
  v.number("m1", m1, above(0));
  v.number("m2", m2, above(0));
  v.number("l1", l1, above(0));
  v.number("l2", l2, above(0));
  v.number("b1", b1, at_least(0));
  v.number("b2", b2, at_least(0));
}

void Options::fields(FieldVisitor& v) {
  v.group("plant", plant);
  v.number("start_noise", start_noise, at_least(0));
  v.number("measurement_noise", measurement_noise, at_least(0));
  v.number("box_low", box_low, at_least(0));
  v.number("box_high", box_high, above(0));
  v.integer("substeps", substeps, at_least(1));
  v.integer("hidden", hidden, at_least(1));
  v.number("policy_gain", policy_gain, above(0));
}

std::shared_ptr<const system::Simulator> make_simulator(const Physics& physics, double dt_s, Index substeps) {
  return std::make_shared<PendubotSimulator>(physics, dt_s, substeps);
}

scenario::Scenario make(const Options& options) {
  scenario::Scenario result;
  result.name = "pendubot";
  result.task = make_task(options);
  result.make_plant = [options, task = result.task] { return make_plant(options, task); };
  for (const Guess& guess : guesses())
    result.priors.push_back({guess.name, make_simulator(guess.physics, kDt, options.substeps),
                             tunable_space(guess.physics, {options.box_low, options.box_high})});
  result.oracle = make_simulator(options.plant, kDt, options.substeps);
  result.policy = policy::make_mlp({.features = result.task.feature_map(),
                                    .scale = Vector{{10, 10, 1, 1, 1, 1}},
                                    .hidden = options.hidden,
                                    .squash = {{{-kTorque, kTorque}}, options.policy_gain}});
  return result;
}

std::unique_ptr<scenario::ScenarioBuilder> builder() { return std::make_unique<Builder>(); }

}  // namespace rehearse::robots::pendubot
