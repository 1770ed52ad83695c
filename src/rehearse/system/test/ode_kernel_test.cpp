#include <cmath>

#include <gtest/gtest.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/system/ode.hpp"
#include "rehearse/system/ode_kernel-inl.hpp"

// For the one instruction set the test is compiled for.
HWY_BEFORE_NAMESPACE();
namespace rehearse::system {
namespace HWY_NAMESPACE {

constexpr double kOmega = 3, kDt = 0.5;

/// Changes of an oscillator x'' = −ω² x + u: columns x, x' of X; u of U.
void oscillate(const Matrix& X, const Matrix& U, Index substeps, Index rows, Matrix& dX) {
  const auto step = [&](auto d, auto* x, const auto* u) {
    const auto stiffness = hn::Set(d, -kOmega * kOmega);
    const auto rhs = [&](auto, const auto* state, auto* slope) {
      slope[0] = state[1];
      slope[1] = hn::MulAdd(stiffness, state[0], u[0]);
    };
    dopri5<2>(d, rhs, x, kDt, substeps);
  };
  for_each_block<2, 1>(X.data(), X.rows(), U.data(), U.rows(), dX.data(), dX.rows(), rows, step);
}

namespace {

TEST(OdeKernel, FollowsTheOscillatorForAnyNumberOfRowsAndStrides) {
  const Matrix X = Matrix::Random(21, 2), U = Matrix::Random(23, 1);
  for (Index rows = 1; rows <= 19; ++rows) {
    Matrix dX = Matrix::Constant(20, 2, 7);
    oscillate(X, U, 40, rows, dX);
    for (Index i = 0; i < rows; ++i) {
      const double rest = U(i, 0) / (kOmega * kOmega), c = std::cos(kOmega * kDt), s = std::sin(kOmega * kDt);
      EXPECT_NEAR(X(i, 0) + dX(i, 0), rest + (X(i, 0) - rest) * c + X(i, 1) / kOmega * s, 1e-10);
      EXPECT_NEAR(X(i, 1) + dX(i, 1), X(i, 1) * c - (X(i, 0) - rest) * kOmega * s, 1e-10);
    }
    EXPECT_EQ(dX.bottomRows(20 - rows), Matrix::Constant(20 - rows, 2, 7)) << "nothing is written behind the last row";
  }
}

TEST(OdeKernel, TakesTheStepsOfTheSimulatorOfEquations) {
  const auto ode = [](const Vector& x, const Vector& u, const Vector&, Vector& dxdt) {
    dxdt(0) = x(1);
    dxdt(1) = -kOmega * kOmega * x(0) + u(0);
  };
  const Matrix X = Matrix::Random(5, 2), U = Matrix::Random(5, 1);
  Matrix ours(5, 2), theirs(5, 2);
  oscillate(X, U, 2, 5, ours);  // so few steps that only the same formula gives the same numbers
  make_ode_simulator(ode, {}, kDt, 2)->change(X, U, {}, theirs);
  EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), 1e-13);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rehearse::system
HWY_AFTER_NAMESPACE();
