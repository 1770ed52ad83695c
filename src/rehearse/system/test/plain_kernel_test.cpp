#include "rehearse/system/plain_kernel.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::system {
namespace {

/// A mass that a force pushes against friction: x'' = (u − b x') / m. State x', x; φ: m, b.
void pushed_mass(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  dxdt << (u(0) - phi(1) * x(0)) / phi(0), x(0);
}

const OdeSizes kSizes{.states = 2, .actions = 1, .parameters = 2};
const Vector kMassAndFriction{{1.6, 0.3}};

TEST(PlainKernel, ItsSlopeIsTheEquation) {
  const OdeKernel kernel = plain_kernel(pushed_mass, kSizes);
  kernel.require_sizes(2, 1, 2);
  Vector slope(2);
  kernel.ode()(Vector{{2, 1}}, Vector{{5}}, kMassAndFriction, slope);
  EXPECT_EQ(slope, (Vector{{(5 - 0.3 * 2) / 1.6, 2}}));
}

TEST(PlainKernel, ItsStepsFollowTheEquation) {
  const Matrix X{{2, 1}, {-0.5, 0}, {0, 3}}, U{{5}, {0}, {-2}};
  Matrix dX(3, 2);
  plain_kernel(pushed_mass, kSizes).change(X, U, kMassAndFriction.data(), 0.1, 4, dX);
  for (Index i = 0; i < 3; ++i) {
    const Vector after = integrate_adaptive(pushed_mass, X.row(i), U.row(i), kMassAndFriction, 0.1);
    EXPECT_LT((X.row(i) + dX.row(i) - after.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(PlainKernel, ARowThatIsNoNumberLeavesTheOthersAlone) {
  const OdeKernel kernel = plain_kernel(pushed_mass, kSizes);
  Matrix alone(1, 2), both(2, 2);
  kernel.change(Matrix{{2, 1}}, Matrix{{5}}, kMassAndFriction.data(), 0.1, 4, alone);
  kernel.change(Matrix{{kNaN, 1}, {2, 1}}, Matrix{{5}, {5}}, kMassAndFriction.data(), 0.1, 4, both);
  EXPECT_TRUE(std::isnan(both(0, 0)));
  EXPECT_EQ(both.row(1), alone.row(0));
}

TEST(PlainKernel, WhatTheEquationDoesNotWriteIsZero) {
  const Ode partial = [](const Vector&, const Vector& u, const Vector&, Vector& dxdt) {
    if (u(0) > 0) dxdt(0) = u(0);
  };
  Matrix dX(2, 1);
  plain_kernel(partial, {.states = 1, .actions = 1}).change(Matrix{{0}, {0}}, Matrix{{1}, {-1}}, nullptr, 1, 1, dX);
  EXPECT_NEAR(dX(0), 1, 1e-14);
  EXPECT_EQ(dX(1), 0);
}

TEST(PlainKernel, AnEquationOfAnotherSizeIsRefused) {
  const Ode longer = [](const Vector&, const Vector&, const Vector&, Vector& dxdt) { dxdt = Vector::Zero(3); };
  Matrix dX(1, 2);
  const OdeKernel kernel = plain_kernel(longer, kSizes);
  EXPECT_THROW(kernel.change(Matrix{{2, 1}}, Matrix{{5}}, kMassAndFriction.data(), 0.1, 4, dX), InvalidInput);
}

}  // namespace
}  // namespace rehearse::system
