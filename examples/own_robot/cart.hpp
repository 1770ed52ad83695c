#pragma once
// Your own robot: a cart that is pushed to the origin. Its mass is 1.6 kg, which we do not know: we guess 1 kg, and let
// a learner find the mass and a policy.

#include <cmath>

#include "rehearse/scenario/ode_builder.hpp"
#include "rehearse/system/plain_kernel.hpp"

using namespace rehearse;

/// The equation: state (velocity, position), action (force), parameters (mass, friction).
inline void equation(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  dxdt << (u(0) - phi(1) * x(0)) / phi(0), x(0);
}

/// The task: from rest at 1 m to the origin within 2 s.
inline Task task() {
  Task task;
  task.states = {{"velocity", "m/s"}, {.name = "position", .unit = "m", .rate = "velocity"}};
  task.actions = {{"force", "N", {-5, 5}}};
  task.start_mean = Vector{{0, 1}};
  task.start_std = Vector::Zero(2);
  task.dt_s = 0.1;
  task.horizon = 20;
  task.reward = reward::saturating([](const ConstMatrixView& X, VectorView d2) { d2 = X.col(1).cwiseAbs2(); }, 0.2);
  task.solved =
      scenario::holds_at_the_end(task, 0.5, each_state([](const ConstVectorView& x) { return std::abs(x(1)) < 0.1; }));
  return task;
}

inline std::unique_ptr<scenario::ScenarioBuilder> cart() {
  const Parameter friction = Parameter::fixed("friction", 0.3, "N s/m");
  const ParameterSpace truth({Parameter::fixed("mass", 1.6, "kg"), friction});
  const ParameterSpace guess({Parameter::continuous("mass", 1, {0.2, 5}, "kg"), friction});
  return scenario::make_ode_builder(
      "push a cart to the origin (20 steps of 0.1 s)",
      {.name = "cart",
       .task = task(),
       .kernel = system::plain_kernel(equation, {.states = 2, .actions = 1, .parameters = 2}),
       .plant = truth,
       .guesses = {{"light", guess}}},
      {.substeps = 4, .policy = {.policy = scenario::PolicyOptions::Kind::linear}});
}
