#pragma once
// A scenario with one option: an oscillator x'' = −ω² x + u with states (x, x').

#include "rehearse/core/options.hpp"
#include "rehearse/scenario/ode_scenario.hpp"

namespace rehearse::scenario::oscillator {

struct Options {
  double omega = 3;
  Index horizon = 5;
  OdeOptions ode{.box_low = 1, .box_high = 5};
  void fields(FieldVisitor& v) {
    v.number("omega", omega, "frequency [rad/s]", above(0));
    v.integer("horizon", horizon, "steps of an episode", at_least(1));
    ode.fields(v);
  }
};

inline void derivative(const double* x, const double* u, const double* phi, double* dxdt) {
  dxdt[0] = x[1];
  dxdt[1] = -phi[0] * phi[0] * x[0] + u[0];
}

/// One step of Euler's: known by its error.
inline void change(const ConstMatrixView& X, const ConstMatrixView& U, const double* phi, double duration_s, Index,
                   MatrixView dX) {
  for (Index i = 0; i < X.rows(); ++i) {
    const Vector x = X.row(i).transpose(), u = U.row(i).transpose();
    Vector slope(2);
    derivative(x.data(), u.data(), phi, slope.data());
    dX.row(i) = duration_s * slope.transpose();
  }
}

inline ParameterSpace parameters(double omega) { return ParameterSpace({Parameter::fixed("omega", omega, "rad/s")}); }

inline Task task(const Options& options) {
  Task task;
  task.states = {{"x", "m"}, {"dx", "m/s"}};
  task.actions = {{"u", "N", {-2, 1}}};
  task.start_mean = Vector{{1, 0}};
  task.start_std = Vector::Constant(2, options.ode.start_noise);
  task.dt_s = 0.1;
  task.horizon = options.horizon;
  task.reward = [](const auto&, const auto&, const auto&, VectorView rewards) { rewards.setZero(); };
  return task;
}

inline Scenario make(const Options& options) {
  return make_ode_scenario(
      {.name = "oscillator",
       .task = task(options),
       .kernel = {.states = 2, .actions = 1, .parameters = 1, .derivative = derivative, .change = change},
       .plant = parameters(options.omega),
       .guesses = {{"slow", parameters(2).tunable_in(options.ode.box(), {"omega"})}, {"fast", parameters(4)}},
       .policy_scale = Vector{{1, 2}}},
      options.ode);
}

}  // namespace rehearse::scenario::oscillator
