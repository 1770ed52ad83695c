#include "rehearse/system/ode.hpp"

#include <stdexcept>
#include <vector>

#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::system {
namespace {

using State = std::vector<double>;
using Stepper = boost::numeric::odeint::runge_kutta_dopri5<State>;

auto rhs_of(const Ode& ode, const Vector& u, const Vector& phi) {
  return [&ode, &u, &phi, x = Vector(), dxdt = Vector()](const State& state, State& change, double) mutable {
    x = Vector::Map(state.data(), static_cast<Index>(state.size()));
    dxdt.setZero(x.size());
    ode(x, u, phi, dxdt);
    Vector::Map(change.data(), x.size()) = dxdt;
  };
}

State to_state(const Vector& x) { return {x.begin(), x.end()}; }

}  // namespace

Vector integrate_adaptive(const Ode& ode, const Vector& x, const Vector& u, const Vector& phi, double duration_s,
                          double tolerance) {
  namespace odeint = boost::numeric::odeint;
  State state = to_state(x);
  Index evaluations = 0;
  const auto counted = [&evaluations, rhs = rhs_of(ode, u, phi)](const State& at, State& change, double t) mutable {
    if (evaluations++ == kMostEvaluations)
      throw std::runtime_error(
          fmt::format("the equation was evaluated {} times within one step: its parameters are too extreme to follow "
                      "it, or it jumps "
                      "(sign, where, floor): write tanh(v / 0.01) for sign(v)",
                      kMostEvaluations));
    rhs(at, change, t);
  };
  odeint::integrate_adaptive(odeint::make_controlled<Stepper>(tolerance, tolerance), counted, state, 0.0, duration_s,
                             duration_s / 16);
  return Vector::Map(state.data(), x.size());
}

Ode OdeKernel::ode() const {
  return [derivative = derivative](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    derivative(x.data(), u.data(), phi.data(), dxdt.data());
  };
}

void OdeKernel::require_sizes(Index dx, Index du, Index phi) const {
  if (dx == states && du == actions && phi == parameters) return;
  throw InvalidInput(
      fmt::format("{} states, {} actions and {} parameters for an equation of {} states, {} actions and {} parameters",
                  dx, du, phi, states, actions, parameters));
}

std::shared_ptr<const Simulator> make_ode_simulator(OdeKernel kernel, ParameterSpace parameters, double dt_s,
                                                    Index substeps) {
  kernel.require_sizes(kernel.states, kernel.actions, parameters.size());
  const auto change = [=](const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
    kernel.require_sizes(X.cols(), U.cols(), kernel.parameters);
    kernel.change(X, U, phi.data(), dt_s, substeps, dX);
  };
  return make_simulator(std::move(parameters), change);
}

std::unique_ptr<Plant> make_ode_plant(OdePlantOptions options) {
  if (!(options.dt_s > 0)) throw InvalidInput(fmt::format("dt_s = {}, must be > 0", options.dt_s));
  const auto motion = [ode = std::move(options.ode), phi = options.phi, dt_s = options.dt_s,
                       tolerance = options.tolerance](const Vector& x, const Vector& u) {
    return integrate_adaptive(ode, x, u, phi, dt_s, tolerance);
  };
  return make_simulated_plant(motion, std::move(options.around));
}

}  // namespace rehearse::system
