#include "rehearse/system/formula_ode.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"

namespace rehearse::system {
namespace {

/// A pendulum on a cart that is pushed: an angle, and slopes that share much.
OdeFormulas swing() {
  return {
      .states = {"dx", "dtheta", "theta"},
      .actions = {"force", "torque"},
      .parameters = {"m", "l", "b"},
      .angles = {"theta"},
      .definitions = {{"inertia", "m * l^2"}, {"pull", "m * 9.81 * l * sin(theta)"}},
      .slopes = {"force / m - b * dx", "(torque + pull - b * dtheta + force * l * cos(theta)) / inertia", "dtheta"}};
}

Vector slopes(const Vector& x, const Vector& u, const Vector& phi) {
  const double m = phi(0), l = phi(1), b = phi(2), inertia = m * l * l;
  return Vector{{u(0) / m - b * x(0),
                 (u(1) + m * 9.81 * l * std::sin(x(2)) - b * x(1) + u(0) * l * std::cos(x(2))) / inertia, x(1)}};
}

const Vector kSwingPhi{{0.7, 0.4, 0.1}};

Matrix random_rows(Index rows, Index columns) {
  Rng rng({.seed = 1});
  Matrix X(rows, columns);
  for (double& value : X.reshaped()) value = 3 * rng.normal();
  return X;
}

TEST(FormulaOde, SlopesAreThoseOfTheFormulas) {
  const OdeKernel kernel = formula_kernel(swing());
  EXPECT_EQ(kernel.states, 3);
  EXPECT_EQ(kernel.actions, 2);
  EXPECT_EQ(kernel.parameters, 3);
  const Matrix X = random_rows(20, 3), U = random_rows(20, 2);
  for (Index i = 0; i < X.rows(); ++i) {
    const Vector x = X.row(i), u = U.row(i), expected = slopes(x, u, kSwingPhi);
    Vector slope(3);
    kernel.derivative(x.data(), u.data(), kSwingPhi.data(), slope.data());
    EXPECT_LT((slope - expected).norm(), 1e-13 * expected.norm());
  }
}

TEST(FormulaOde, ChangesAreThoseOfAnAdaptiveIntegrator) {
  const OdeKernel kernel = formula_kernel(swing());
  const Matrix X = random_rows(150, 3), U = random_rows(150, 2);
  Matrix dX(150, 3);
  kernel.change(X, U, kSwingPhi.data(), 0.05, 20, dX);
  const auto ode = [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) { dxdt = slopes(x, u, phi); };
  for (Index i = 0; i < X.rows(); i += 7) {
    const Vector x = X.row(i), after = integrate_adaptive(ode, x, U.row(i), kSwingPhi, 0.05);
    EXPECT_LT((x + dX.row(i).transpose() - after).norm(), 1e-8) << i;
  }
}

TEST(FormulaOde, ARowDoesNotDependOnTheOthers) {
  const OdeKernel kernel = formula_kernel(swing());
  const Matrix X = random_rows(100, 3), U = random_rows(100, 2);
  Matrix all(100, 3), some(3, 3);
  kernel.change(X, U, kSwingPhi.data(), 0.05, 5, all);
  kernel.change(X.middleRows(70, 3), U.middleRows(70, 3), kSwingPhi.data(), 0.05, 5, some);
  EXPECT_EQ(some, all.middleRows(70, 3));
}

TEST(FormulaOde, ARowThatLosesItsWayFailsAlone) {
  const OdeKernel kernel = formula_kernel(swing());
  Matrix X = random_rows(10, 3);
  X(3, 1) = 1e300;
  X(5, 1) = 1e7;
  Matrix dX(10, 3);
  kernel.change(X, random_rows(10, 2), kSwingPhi.data(), 0.05, 5, dX);
  for (Index i = 0; i < 10; ++i) EXPECT_EQ(dX.row(i).array().isNaN().all(), i == 3 || i == 5) << i;
}

TEST(FormulaOde, WrongFormulasAreRefused) {
  OdeFormulas wrong = swing();
  wrong.slopes[0] = "forse / m";
  EXPECT_THROW(formula_kernel(wrong), InvalidInput);
}

}  // namespace
}  // namespace rehearse::system
