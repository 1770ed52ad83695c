#pragma once
// A damped swing to learn from: states (dθ/dt, θ), the torque on it, parameters length and friction.

#include <cmath>
#include <memory>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/feature_map.hpp"
#include "rehearse/core/kinematics.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/prior/prior.hpp"
#include "rehearse/system/plain_kernel.hpp"

namespace rehearse::swing {

inline void ode(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  dxdt(0) = -9.81 / phi(0) * std::sin(x(1)) - phi(1) * x(0) + 4 * u(0);
  dxdt(1) = x(0);
}

inline const Vector kTruth{{0.8, 0.3}};

inline Parameter length(double value = 0.5) { return Parameter::continuous("length", value, {0.3, 2}); }
inline Parameter friction(double value = 0.1) { return Parameter::continuous("friction", value, {0, 1}); }

inline prior::Prior prior(std::vector<Parameter> parameters, system::Ode equation = ode) {
  const ParameterSpace space(std::move(parameters));
  return {"swing", system::make_ode_simulator(std::move(equation), space, 0.1, 4), space};
}

inline prior::Prior prior_at(const Vector& phi) {
  prior::Prior result = prior({length(), friction()});
  result.space = result.space.fixed_at(phi);
  return result;
}

inline Kinematics kinematics() { return {.dt_s = 0.1, .pairs = {{.position = 1, .rate = 0}}}; }

inline FeatureMap features() { return FeatureMap({StateKind::plain, StateKind::angle}); }

/// n independent steps of the true swing from |dθ/dt| ≤ 4 and any angle, |u| ≤ 1.
inline Dataset data(Index n, std::uint64_t seed, const Vector& phi = kTruth) {
  Rng rng({.seed = seed});
  Dataset data{.states = Matrix(n, 2), .actions = Matrix(n, 1), .changes = Matrix(n, 2)};
  for (Index i = 0; i < n; ++i) {
    data.states(i, 0) = rng.uniform(-4, 4);
    data.states(i, 1) = rng.uniform(-M_PI, M_PI);
    data.actions(i, 0) = rng.uniform(-1, 1);
  }
  prior_at(phi).mean(data.states, data.actions, phi, data.changes);
  return data;
}

/// Root mean square over rows and outputs.
inline double rms(const Matrix& errors) { return std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size())); }

}  // namespace rehearse::swing
