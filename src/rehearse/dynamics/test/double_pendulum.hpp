#pragma once
// A double pendulum whose lever arm and inertia are tunable, too: m1, m2, r2 and I1 act only as m1 + m2, m2·r2 and
// I1 + l1² m2. States (dq1/dt, dq2/dt, q1, q2), q1 from hanging, q2 relative to link 1; both joints driven.

#include <cmath>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/feature_map.hpp"
#include "rehearse/core/kinematics.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/prior/prior.hpp"
#include "rehearse/system/plain_kernel.hpp"

namespace rehearse::double_pendulum {

inline constexpr double kLength = 0.3, kInertia2 = 0.025, kFriction = 0.05, kGravity = 9.81, kStep = 0.05;

/// φ = (m1, m2, r2, I1).
inline void ode(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  const double m1 = phi(0), moment = phi(1) * phi(2), s2 = std::sin(x(3)), coupling = moment * kLength * std::cos(x(3));
  const double M11 = phi(3) + kInertia2 + phi(1) * kLength * kLength + 2 * coupling, M12 = kInertia2 + coupling;
  const double coriolis = moment * kLength * s2, lever = kGravity * moment * std::sin(x(2) + x(3));
  const double f1 = u(0) + coriolis * (2 * x(0) * x(1) + x(1) * x(1)) -
                    kGravity * (m1 + phi(1)) * kLength * std::sin(x(2)) - lever - kFriction * x(0);
  const double f2 = u(1) - coriolis * x(0) * x(0) - lever - kFriction * x(1);
  const double determinant = M11 * kInertia2 - M12 * M12;
  dxdt(0) = (kInertia2 * f1 - M12 * f2) / determinant;
  dxdt(1) = (M11 * f2 - M12 * f1) / determinant;
  dxdt(2) = x(0);
  dxdt(3) = x(1);
}

inline const Vector kTruth{{0.608, 0.63, 0.166, 0.0547}};

inline prior::Prior prior() {
  const ParameterSpace space(
      {Parameter::continuous("m1", 0.5, {0.1, 1.2}, "kg"), Parameter::continuous("m2", 0.45, {0.1, 1.2}, "kg"),
       Parameter::continuous("r2", 0.2, {0.05, 0.5}, "m"), Parameter::continuous("I1", 0.04, {0.01, 0.15}, "kg m²")});
  return {"double pendulum", system::make_ode_simulator(ode, space, kStep, 4), space};
}

inline FeatureMap features() {
  return FeatureMap({StateKind::plain, StateKind::plain, StateKind::angle, StateKind::angle});
}

inline Kinematics kinematics() {
  return {.dt_s = kStep, .pairs = {{.position = 2, .rate = 0}, {.position = 3, .rate = 1}}};
}

/// One episode of n steps of the prior at the truth, from hanging under torques that are drawn every 0.25 s; each state
/// measured with that noise.
inline Dataset episode(Index n, std::uint64_t seed, double noise = 0) {
  Rng rng({.seed = seed});
  const prior::Prior true_prior = prior();
  Matrix states = Matrix::Zero(n + 1, 4), actions(n, 2), change(1, 4);
  for (Index t = 0; t < n; ++t) {
    for (Index j = 0; j < 2; ++j) actions(t, j) = t % 5 > 0 ? actions(t - 1, j) : rng.uniform(-1, 1) * (j == 0 ? 4 : 1);
    true_prior.mean(states.row(t), actions.row(t), kTruth, change);
    states.row(t + 1) = states.row(t) + change;
  }
  for (double& state : states.reshaped()) state += noise * rng.normal();
  return {.states = states.topRows(n), .actions = actions, .changes = states.bottomRows(n) - states.topRows(n)};
}

}  // namespace rehearse::double_pendulum
