#pragma once
// Ordinary differential equations dx/dt = f(x, u; φ) as simulators and as plants.

#include <functional>
#include <memory>

#include "rehearse/core/parameters.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/system/plant.hpp"
#include "rehearse/system/simulated_plant.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::system {

/// dx/dt at state x (dx) under the constant action u (du), written to dxdt (dx). Any thread.
using Ode = std::function<void(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt)>;

/// The most evaluations of an adaptive integration; a robot's control step takes some hundreds.
constexpr Index kMostEvaluations = 1'000'000;

/// The state after `duration_s`, by adaptive Dormand–Prince 5 with absolute and relative tolerance. Throws
/// std::runtime_error if the step size vanishes, or if that takes more than kMostEvaluations of the equation.
Vector integrate_adaptive(const Ode& ode, const Vector& x, const Vector& u, const Vector& phi, double duration_s,
                          double tolerance = 1e-12);

/// An equation, vectorised over rows: what equation_kernel.hpp makes of a robot's, and formula_ode.hpp of formulas. Any
/// thread.
struct OdeKernel {
  Index states = 0, actions = 0, parameters = 0;  // dx, du, size of φ

  /// dxdt (dx) at state x (dx) under the action u (du).
  std::function<void(const double* x, const double* u, const double* phi, double* dxdt)> derivative;

  /// Changes dX of states X (n × dx) under actions U (n × du) over duration_s, by so many steps of Dormand–Prince 5. A
  /// row that leaves the range of the equation comes back as NaN.
  std::function<void(const ConstMatrixView& X, const ConstMatrixView& U, const double* phi, double duration_s,
                     Index steps, MatrixView dX)>
      change;

  Ode ode() const;

  void require_sizes(Index dx, Index du, Index phi) const;  // throws InvalidInput unless these are the kernel's
};

/// A simulator that takes `substeps` of them in each control step.
std::shared_ptr<const Simulator> make_ode_simulator(OdeKernel kernel, ParameterSpace parameters, double dt_s,
                                                    Index substeps);

/// A simulated robot: the equation under an adaptive integrator, with Gaussian start and measurements.
struct OdePlantOptions {
  Ode ode;
  Vector phi;
  double dt_s = 0;
  StartAndSensors around;
  double tolerance = 1e-12;
};
std::unique_ptr<Plant> make_ode_plant(OdePlantOptions options);

}  // namespace rehearse::system
