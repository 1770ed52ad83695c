#include "rehearse/system/ode.hpp"

#include <optional>
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

class OdeSimulator final : public Simulator {
 public:
  OdeSimulator(Ode ode, ParameterSpace parameters, double dt_s, Index substeps)
      : ode_(std::move(ode)), parameters_(std::move(parameters)), dt_s_(dt_s), substeps_(substeps) {}

  const ParameterSpace& parameters() const override { return parameters_; }

  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const override {
    check_sizes(*this, X, U, phi, dX);
    for (Index i = 0; i < X.rows(); ++i) {
      const Vector u = U.row(i).transpose();
      State state = to_state(X.row(i).transpose());
      Stepper stepper;
      const auto rhs = rhs_of(ode_, u, phi);
      const double h = dt_s_ / static_cast<double>(substeps_);
      for (Index s = 0; s < substeps_; ++s) stepper.do_step(rhs, state, static_cast<double>(s) * h, h);
      dX.row(i) = Vector::Map(state.data(), X.cols()).transpose() - X.row(i);
    }
  }

 private:
  Ode ode_;
  ParameterSpace parameters_;
  double dt_s_;
  Index substeps_;
};

class OdePlant final : public Plant {
 public:
  explicit OdePlant(OdePlantOptions options) : options_(std::move(options)) {}

  Vector reset(Rng& rng) override {
    x_ = options_.start_mean;
    for (Index i = 0; i < x_.size(); ++i) x_(i) += options_.start_std(i) * rng.normal();
    rng_ = rng;
    return measured();
  }

  Vector step(const Vector& u) override {
    if (!rng_) throw std::logic_error("the plant makes a step before it was reset");
    x_ = integrate_adaptive(options_.ode, x_, u, options_.phi, options_.dt_s, options_.tolerance);
    return measured();
  }

  Vector truth() const override { return x_; }

 private:
  Vector measured() {
    Vector y = x_;
    for (Index i = 0; i < options_.measurement_std.size(); ++i) y(i) += options_.measurement_std(i) * rng_->normal();
    return y;
  }

  OdePlantOptions options_;
  Vector x_;
  std::optional<Rng> rng_;
};

}  // namespace

Vector integrate_adaptive(const Ode& ode, const Vector& x, const Vector& u, const Vector& phi, double duration_s,
                          double tolerance) {
  namespace odeint = boost::numeric::odeint;
  State state = to_state(x);
  Index evaluations = 0;
  const auto counted = [&evaluations, rhs = rhs_of(ode, u, phi)](const State& at, State& change, double t) mutable {
    if (evaluations++ == kMostEvaluations)
      throw std::runtime_error(fmt::format(
          "the equation was evaluated {} times within one step: its parameters are too extreme to follow it",
          kMostEvaluations));
    rhs(at, change, t);
  };
  odeint::integrate_adaptive(odeint::make_controlled<Stepper>(tolerance, tolerance), counted, state, 0.0, duration_s,
                             duration_s / 16);
  return Vector::Map(state.data(), x.size());
}

std::shared_ptr<const Simulator> make_ode_simulator(Ode ode, ParameterSpace parameters, double dt_s, Index substeps) {
  return std::make_shared<OdeSimulator>(std::move(ode), std::move(parameters), dt_s, substeps);
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
  const Index n = options.start_mean.size(), noisy = options.measurement_std.size();
  Violations violations;
  violations.require(
      options.start_std.size() == n,
      fmt::format("start_std has {} entries, must have the {} of start_mean", options.start_std.size(), n));
  violations.require(noisy == 0 || noisy == n,
                     fmt::format("measurement_std has {} entries, must have none or the {} of start_mean", noisy, n));
  violations.require(options.dt_s > 0, fmt::format("dt_s = {}, must be > 0", options.dt_s));
  violations.throw_if_any();
  return std::make_unique<OdePlant>(std::move(options));
}

}  // namespace rehearse::system
