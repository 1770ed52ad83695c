#pragma once

#include <cmath>
#include <vector>

#include "rehearse/core/random.hpp"
#include "rehearse/study/study.hpp"

namespace rehearse::study {

/// A damped pendulum by Euler's rule: dq, q, torque; φ: weight, damping.
inline void swing(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
  for (Index i = 0; i < X.rows(); ++i) {
    dX(i, 0) = 0.02 * (U(i, 0) - phi(0) * std::sin(X(i, 1)) - phi(1) * X(i, 0));
    dX(i, 1) = 0.02 * X(i, 0);
  }
}

inline Task swinging_task() {
  Task task;
  task.states = {{"dq", "rad/s"}, {"q", "rad", StateKind::angle, "dq"}};
  task.actions = {{"torque", "N m", {-3, 3}}};
  task.start_mean = task.start_std = Vector::Zero(2);
  task.dt_s = 0.02;
  task.horizon = 100;
  return task;
}

inline prior::Prior swinging_prior() {
  const ParameterSpace space(
      {Parameter::continuous("weight", 4, {1, 12}), Parameter::continuous("damping", 1, {0, 2})});
  return {"guess", system::make_simulator(space, swing), space};
}

/// Eight seconds of a pendulum of weight 6 and damping 0.5, with noise, whose encoder is off by an angle. Without
/// `push` it hangs at rest.
inline Log swinging_log(std::uint64_t seed, double zero, double noise = 0.002, double push = 1) {
  constexpr Index kSteps = 400;
  Rng rng({.seed = seed});
  Episode episode{.states = Matrix(kSteps + 1, 2), .actions = Matrix(kSteps, 1), .rewards = Vector::Zero(kSteps)};
  Matrix x = Matrix::Zero(1, 2), change(1, 2);
  const double speed = rng.uniform(1, 3), strength = rng.uniform(1, 2.5);
  for (Index t = 0; t <= kSteps; ++t) {
    episode.states.row(t) << x(0, 0) + 10 * noise * rng.normal(), x(0, 1) - zero + noise * rng.normal();
    if (t == kSteps) break;
    episode.actions(t, 0) = push * strength * std::sin(speed * 0.02 * static_cast<double>(t));
    swing(x, episode.actions.row(t), Vector{{6, 0.5}}, change);
    x += change;
  }
  episode.true_states = episode.states;
  return {"log " + std::to_string(seed), episode, episode.states};
}

/// A study of three such logs, and of a fourth that is forecast.
struct Case {
  Task task = swinging_task();
  prior::Prior prior = swinging_prior();
  std::vector<Log> logs = {swinging_log(1, 0.1), swinging_log(2, -0.08), swinging_log(3, 0.02)};
  std::vector<Log> held_out = {swinging_log(4, -0.04)};
  Options options;
  Case() { options.zeros = "q", options.rows = 150, options.particles = 20; }
  Problem problem() const { return {task, prior, logs, held_out}; }
  Study run() const { return study_logs(problem(), options, serial_evaluator()); }
};

}  // namespace rehearse::study
