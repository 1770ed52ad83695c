// The pendulum of docs/same-robot.md in C++. The program has every command of `rehearse`:
//
//   in_cpp learn rod --learner gp-mi --trials 2 --until-solved

#include <cmath>
#include <numbers>

#include "rehearse/cli/cli.hpp"
#include "rehearse/scenario/ode_builder.hpp"
#include "rehearse/system/plain_kernel.hpp"

using namespace rehearse;

/// The equation: state (dtheta, theta), action (torque), parameters (m, l). A uniform rod, its angle 0 when it hangs.
void equation(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  const double m = phi(0), l = phi(1);
  dxdt << (u(0) - 0.01 * x(0) - m * 9.82 * l / 2 * std::sin(x(1))) / (m * l * l / 3), x(0);
}

/// Half squared distances to the upright are ½ ((1 + cos θ)² + sin² θ).
void squared_distance(const ConstMatrixView& X, VectorView d2) {
  d2 = (1 + X.col(1).array().cos()).square() + X.col(1).array().sin().square();
}

bool upright(const ConstVectorView& x) { return -std::cos(x(1)) > std::cos(10 * std::numbers::pi / 180); }

Task task() {
  Task task;
  task.states = {{"dtheta", "rad/s"}, {.name = "theta", .unit = "rad", .kind = StateKind::angle, .rate = "dtheta"}};
  task.actions = {{"u", "N m", {-2.5, 2.5}}};
  task.start_mean = Vector::Zero(2);
  task.start_std = Vector::Zero(2);
  task.dt_s = 0.1;
  task.horizon = 40;
  task.reward = reward::saturating(squared_distance, 0.5);
  task.solved = scenario::holds_at_the_end(task, 0.5, each_state(upright));
  return task;
}

std::unique_ptr<scenario::ScenarioBuilder> rod() {
  const ParameterSpace truth({Parameter::fixed("m", 1, "kg"), Parameter::fixed("l", 1, "m")});
  const ParameterSpace guess(
      {Parameter::continuous("m", 1.3, {0.05, 2}, "kg"), Parameter::continuous("l", 0.8, {0.05, 2}, "m")});
  return scenario::make_ode_builder(
      "swing up a pendulum (40 steps of 0.1 s)",
      {.name = "rod",
       .task = task(),
       .kernel = system::plain_kernel(equation, {.states = 2, .actions = 1, .parameters = 2}),
       .plant = truth,
       .guesses = {{"useful", guess}},
       .policy_scale = Vector{{10, 1, 1}}});
}

int main(int argc, char** argv) { return rehearse::cli(argc, argv, {rod}); }
