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

/// The oscillator without a force, and the integral of x, which nothing depends on.
template <int kInner>
Matrix oscillate_and_sum(const Matrix& X) {
  Matrix dX(X.rows(), 3);
  const auto step = [](auto d, auto* x, const auto*) {
    const auto rhs = [](auto d1, const auto* state, auto* slope) {
      slope[0] = state[1];
      slope[1] = hn::Mul(hn::Set(d1, -kOmega * kOmega), state[0]);
      slope[2] = state[0];
    };
    dopri5<3, kInner>(d, rhs, x, kDt, 20);
  };
  for_each_block<3, 1>(X.data(), X.rows(), X.data(), X.rows(), dX.data(), dX.rows(), X.rows(), step);
  return dX;
}

/// Two pendulums side by side, the first driven, coupled by a spring of angle: states ω1, θ1, ω2, θ2; φ: stiffness.
template <class D>
struct Pendulums {
  using V = Vec<D>;
  static constexpr int kStates = 4;
  static constexpr int kAngles[] = {1, 3};
  Pendulums(D d, const double* phi) : stiffness(hn::Set(d, phi[0])), gravity(hn::Set(d, 9.82)) {}
  void operator()(const V* x, const V* trig, V u, V* dxdt) const {
    // sin(θ1 − θ2)
    const V pull = hn::Mul(stiffness, hn::NegMulAdd(trig[1], trig[2], hn::Mul(trig[0], trig[3])));
    dxdt[0] = hn::Sub(u, hn::MulAdd(gravity, trig[0], pull));
    dxdt[1] = x[0];
    dxdt[2] = hn::NegMulAdd(gravity, trig[2], pull);
    dxdt[3] = x[2];
  }
  V stiffness, gravity;
};

void pendulums(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  const double pull = phi(0) * std::sin(x(1) - x(3));
  dxdt << u(0) - 9.82 * std::sin(x(1)) - pull, x(0), pull - 9.82 * std::sin(x(3)), x(2);
}

const Vector kStiffness{{5}};

void swing(const Matrix& X, const Matrix& U, Index substeps, Matrix& dX) {
  change_rows<Pendulums>(X.data(), X.rows(), U.data(), kStiffness.data(), 0.1, substeps, dX.data(), dX.rows(),
                         X.rows());
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

TEST(OdeKernel, IntegralsNeedNoStages) {
  const Matrix X = Matrix::Random(11, 3), dX = oscillate_and_sum<2>(X);
  EXPECT_EQ(dX, oscillate_and_sum<3>(X));
  const Vector sum = -dX.col(1) / (kOmega * kOmega);  // x'' = −ω² x
  EXPECT_LT((dX.col(2) - sum).cwiseAbs().maxCoeff(), 1e-8);
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

TEST(OdeKernel, AnglesTurnWithoutAnErrorOfTheirOwn) {
  Matrix X = 3 * Matrix::Random(21, 4), U = Matrix::Random(21, 1);
  X.col(0) *= 10;  // up to 30 rad/s
  Matrix ours(21, 4), theirs(21, 4);
  for (const Index substeps : {6, 12}) {
    swing(X, U, substeps, ours);
    make_ode_simulator(pendulums, {}, 0.1, substeps)->change(X, U, kStiffness, theirs);
    EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), 1e-12) << substeps;
  }
  for (Index i = 0; i < 21; ++i) {
    const Vector x = X.row(i).transpose(), u = U.row(i).transpose();
    Vector slope(4), expected(4);
    slope_of_row<Pendulums>(x.data(), u(0), kStiffness.data(), slope.data());
    pendulums(x, u, kStiffness, expected);
    EXPECT_LT((slope - expected).norm(), 1e-12);
  }
}

TEST(OdeKernel, FarAnglesAreAngles) {
  Matrix X = Matrix::Random(21, 4), U = Matrix::Random(21, 1), ours(21, 4), theirs(21, 4);
  X.col(1) += 1e6 * Vector::LinSpaced(21, -1, 1);
  X.col(3) = X.col(1).reverse();
  swing(X, U, 12, ours);
  make_ode_simulator(pendulums, {}, 0.1, 12)->change(X, U, kStiffness, theirs);
  EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), 1e-8) << "1e6 rad end at 1e-10";
}

TEST(OdeKernel, TurnsBeyondAllReasonAreNanInTheirRowAlone) {
  const Matrix X = Matrix::Random(11, 4), U = Matrix::Random(11, 1);
  Matrix clean(11, 4), dX(11, 4);
  swing(X, U, 4, clean);
  for (const Index column : {0, 2}) {
    Matrix far = X;
    far(4, column) = 1e7;
    swing(far, U, 4, dX);
    for (Index i = 0; i < 11; ++i)
      EXPECT_TRUE(i == 4 ? dX.row(i).array().isNaN().all() : dX.row(i) == clean.row(i)) << i;
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rehearse::system
HWY_AFTER_NAMESPACE();
