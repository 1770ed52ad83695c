#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/system/ode.hpp"
#include "rehearse/system/plain_kernel.hpp"
#include "rehearse/testing/check_ode_kernel.hpp"

#define REHEARSE_EQUATION "rehearse/system/test/spring.hpp"
#include "rehearse/system/equation_kernel.hpp"

namespace rehearse::system {
namespace {

constexpr double kDt = 0.5;
const Vector kOmega{{3}};

void spring(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  dxdt << x(1), u(0) + 2 * u(1) - phi(0) * phi(0) * x(0);
}

TEST(EquationKernel, FollowsTheSpringForAnyNumberOfRowsAndStrides) {
  const Matrix X = Matrix::Random(21, 2), U = Matrix::Random(23, 2);
  for (Index rows = 1; rows <= 19; ++rows) {
    Matrix dX = Matrix::Constant(20, 2, 7);
    equation_kernel().change(X.topRows(rows), U.topRows(rows), kOmega.data(), kDt, 40, dX.topRows(rows));
    for (Index i = 0; i < rows; ++i) {
      const double w = kOmega(0), rest = (U(i, 0) + 2 * U(i, 1)) / (w * w), c = std::cos(w * kDt),
                   s = std::sin(w * kDt);
      EXPECT_NEAR(X(i, 0) + dX(i, 0), rest + (X(i, 0) - rest) * c + X(i, 1) / w * s, 1e-10);
      EXPECT_NEAR(X(i, 1) + dX(i, 1), X(i, 1) * c - (X(i, 0) - rest) * w * s, 1e-10);
    }
    EXPECT_EQ(dX.bottomRows(20 - rows), Matrix::Constant(20 - rows, 2, 7)) << "nothing is written behind the last row";
  }
}

TEST(EquationKernel, TakesTheStepsOfTheSimulatorOfEquations) {
  const Matrix X = Matrix::Random(5, 2), U = Matrix::Random(5, 2);
  Matrix ours(5, 2), theirs(5, 2);  // of so few steps that only the same formula gives the same numbers
  const ParameterSpace space({Parameter::fixed("omega", 3)});
  make_ode_simulator(equation_kernel(), space, kDt, 2)->change(X, U, kOmega, ours);
  make_ode_simulator(spring, space, kDt, 2)->change(X, U, kOmega, theirs);
  EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(EquationKernel, ItsDerivativeIsTheEquation) {
  const Vector x = Vector::Random(2), u = Vector::Random(2);
  Vector ours(2), theirs(2);
  equation_kernel().ode()(x, u, kOmega, ours);
  spring(x, u, kOmega, theirs);
  EXPECT_LT((ours - theirs).norm(), 1e-14);
  EXPECT_LT(
      (integrate_adaptive(equation_kernel().ode(), x, u, kOmega, kDt) - integrate_adaptive(spring, x, u, kOmega, kDt))
          .norm(),
      1e-11);
}

TEST(EquationKernel, KeepsItsInstructionSet) {
  EXPECT_EQ(testing::check_ode_kernel(equation_kernel), std::vector<std::string>{});
}

TEST(EquationKernel, RefusesOtherSizesThanItsOwn) {
  EXPECT_THROW(make_ode_simulator(equation_kernel(), ParameterSpace(), kDt, 2), InvalidInput);
  const auto simulator = make_ode_simulator(equation_kernel(), ParameterSpace({Parameter::fixed("omega", 3)}), kDt, 2);
  Matrix dX(4, 2);
  EXPECT_NO_THROW(simulator->change(Matrix::Zero(4, 2), Matrix::Zero(4, 2), kOmega, dX));
  try {
    simulator->change(Matrix::Zero(4, 2), Matrix::Zero(4, 1), kOmega, dX);
    FAIL() << "one action is too few";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(),
                 "2 states, 1 actions and 1 parameters for an equation of 2 states, 2 actions and 1 parameters");
  }
}

}  // namespace
}  // namespace rehearse::system
