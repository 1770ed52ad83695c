#include "rehearse/system/ode.hpp"

#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/system/plain_kernel.hpp"

namespace rehearse::system {
namespace {

/// x'' = −ω² x + u: states (x, x'), φ = (ω).
void oscillator(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  dxdt(0) = x(1);
  dxdt(1) = -phi(0) * phi(0) * x(0) + u(0);
}

/// Its state after t seconds.
Vector exact(const Vector& x, double u, double omega, double t) {
  const double rest = u / (omega * omega), c = std::cos(omega * t), s = std::sin(omega * t);
  return Vector{{rest + (x(0) - rest) * c + x(1) / omega * s, -(x(0) - rest) * omega * s + x(1) * c}};
}

ParameterSpace omega(double value) { return ParameterSpace({Parameter::fixed("omega", value)}); }

const Vector kPhi{{3}};

TEST(IntegrateAdaptive, FollowsTheHarmonicOscillator) {
  for (const double t : {0.05, 1.0, 10.0}) {
    const Vector x{{0.4, -1}}, u{{0.7}};
    EXPECT_LT((integrate_adaptive(oscillator, x, u, kPhi, t) - exact(x, 0.7, 3, t)).norm(), 1e-10 * (1 + t)) << t;
  }
}

TEST(IntegrateAdaptive, ToleranceIsKept) {
  const Vector x{{0.4, -1}}, u{{0}};
  const auto error = [&](double tolerance) {
    return (integrate_adaptive(oscillator, x, u, kPhi, 1, tolerance) - exact(x, 0, 3, 1)).norm();
  };
  EXPECT_LT(error(1e-6), 1e-4);
  EXPECT_LT(error(1e-12), 1e-10);
  EXPECT_LT(error(1e-12), error(1e-6));
}

TEST(IntegrateAdaptive, AStateThatIsNoStateComesToAnEnd) {
  const auto before = std::chrono::steady_clock::now();
  for (const double bad : {kNaN, kInf, -kInf, 1e300}) {
    try {
      const Vector x = integrate_adaptive(oscillator, Vector{{bad, 0}}, Vector{{0}}, kPhi, 0.05);
      EXPECT_TRUE(!x.allFinite() || bad == 1e300) << bad;
    } catch (const std::exception&) {
    }
  }
  const auto explosion = [](const Vector& x, const Vector&, const Vector&, Vector& dxdt) {
    dxdt(0) = x(0) * x(0);  // reaches infinity after one second
  };
  try {
    EXPECT_FALSE(integrate_adaptive(explosion, Vector{{1}}, Vector{{0}}, kPhi, 2).allFinite());
  } catch (const std::exception&) {
  }
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(20));
}

TEST(IntegrateAdaptive, AStepThatCostsTooMuchIsRefusedWithTheReason) {
  Index evaluations = 0;
  const auto stiff = [&](const Vector& x, const Vector&, const Vector& phi, Vector& dxdt) {
    ++evaluations;
    dxdt(0) = phi(0) * (1 - x(0));
  };
  EXPECT_NEAR(integrate_adaptive(stiff, Vector{{0}}, Vector{{0}}, Vector{{1e3}}, 0.1)(0), 1, 1e-9);
  EXPECT_LT(evaluations, kMostEvaluations / 100);
  evaluations = 0;
  try {
    integrate_adaptive(stiff, Vector{{0}}, Vector{{0}}, Vector{{1e9}}, 0.1);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "the equation was evaluated 1000000 times within one step: its parameters are too extreme to follow "
                 "it, or it jumps (sign, where, floor): write tanh(v / 0.01) for sign(v)");
  }
  EXPECT_EQ(evaluations, kMostEvaluations);
}

// The fifth order: half the step, 2^5 = 32 times less error.
TEST(OdeSimulator, ConvergesWithTheFifthOrder) {
  const Matrix X{{0.4, -1}}, U{{0.7}};
  const auto error = [&](Index substeps) {
    Matrix dX(1, 2);
    make_ode_simulator(oscillator, omega(3), 1, substeps)->change(X, U, kPhi, dX);
    return ((X + dX).transpose() - exact(X.row(0), 0.7, 3, 1)).norm();
  };
  for (const Index substeps : {16, 32, 64}) {
    const double ratio = error(substeps) / error(2 * substeps);
    EXPECT_GT(ratio, 26) << substeps;
    EXPECT_LT(ratio, 40) << substeps;
  }
}

TEST(OdeSimulator, RowsAndParametersAreTheirOwn) {
  const auto simulator = make_ode_simulator(oscillator, omega(3), 0.1, 8);
  EXPECT_EQ(simulator->parameters().names(), std::vector<std::string>{"omega"});
  const Matrix X = Matrix::Random(9, 2), U = Matrix::Random(9, 1);
  Matrix dX(9, 2), one(1, 2);
  for (const double w : {1.0, 3.0}) {
    simulator->change(X, U, Vector{{w}}, dX);
    for (Index i = 0; i < 9; ++i) {
      EXPECT_LT(((X + dX).row(i).transpose() - exact(X.row(i), U(i, 0), w, 0.1)).norm(), 1e-8);
      simulator->change(X.row(i), U.row(i), Vector{{w}}, one);
      EXPECT_EQ(one, dX.row(i));
    }
  }
}

TEST(OdeSimulator, CallsItsKernelWithItsRows) {
  const OdeKernel kernel{.states = 2,
                         .actions = 1,
                         .parameters = 1,
                         .derivative =
                             [](const double* x, const double* u, const double* phi, double* dxdt) {
                               dxdt[0] = x[1];
                               dxdt[1] = -phi[0] * phi[0] * x[0] + u[0];
                             },
                         .change =
                             [](const ConstMatrixView& states, const ConstMatrixView& actions, const double* phi,
                                double duration_s, Index steps, MatrixView changes) {
                               changes.col(0) = (states.col(0) + actions.col(0)).array() + phi[0];
                               changes.col(1) = states.col(1).array() + duration_s + static_cast<double>(steps);
                             }};
  const Matrix X = Matrix::Random(7, 2), U = Matrix::Random(7, 1);
  Matrix dX(7, 2);
  make_ode_simulator(kernel, omega(3), 0.25, 8)->change(X.middleRows(2, 4), U.middleRows(2, 4), kPhi, dX.topRows(4));
  EXPECT_EQ(dX.col(0).head(4), ((X.col(0).segment(2, 4) + U.col(0).segment(2, 4)).array() + 3).matrix());
  EXPECT_EQ(dX.col(1).head(4), (X.col(1).segment(2, 4).array() + 0.25 + 8).matrix());

  Vector ours(2), theirs(2);
  kernel.ode()(Vector{{0.4, -1}}, Vector{{0.7}}, kPhi, ours);
  oscillator(Vector{{0.4, -1}}, Vector{{0.7}}, kPhi, theirs);
  EXPECT_EQ(ours, theirs);
}

OdePlantOptions plant_options() {
  return {.ode = oscillator, .phi = kPhi, .dt_s = 0.1, .around = {Vector{{1, 0}}, Vector{{0, 0}}, {}}};
}

TEST(OdePlant, WithoutNoiseFollowsTheEquation) {
  const auto plant = make_ode_plant(plant_options());
  Rng rng({.seed = 1});
  Vector expected = plant->reset(rng);
  EXPECT_EQ(expected, (Vector{{1, 0}}));
  for (int t = 0; t < 20; ++t) {
    expected = exact(expected, 0.5, 3, 0.1);
    const Vector measured = plant->step(Vector{{0.5}});
    EXPECT_LT((measured - expected).norm(), 1e-9);
    EXPECT_EQ(measured, plant->truth());
  }
}

TEST(OdePlant, AStepTakesTime) {
  OdePlantOptions wrong = plant_options();
  wrong.dt_s = 0;
  EXPECT_THROW(make_ode_plant(wrong), InvalidInput);
}

}  // namespace
}  // namespace rehearse::system
