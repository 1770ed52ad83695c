#include "rehearse/testing/hostile.hpp"

#include <gtest/gtest.h>

#include "rehearse/system/plain_kernel.hpp"

namespace rehearse::testing {
namespace {

std::shared_ptr<const system::Simulator> still() {
  const auto stays = [](const Vector&, const Vector&, const Vector&, Vector& dxdt) { dxdt.setZero(); };
  return system::make_ode_simulator(stays, {}, 0.1, 1);
}

// 10 000 rows, fraction 1 %: 100 failures are expected, with a deviation of 10; beyond 5 of them with probability 6e-7.
TEST(Hostile, FailsInItsFractionOfTheRowsWhateverTheHarm) {
  const Matrix X = Matrix::Random(10000, 2), U = Matrix::Random(10000, 1);
  Matrix first;
  for (const Harm harm : {Harm::nan, Harm::huge, Harm::exception}) {
    Matrix dX(10000, 2);
    const Index failed = system::change_contained(*make_hostile(still(), harm, 0.01), X, U, {}, dX);
    EXPECT_NEAR(static_cast<double>(failed), 100, 50);
    const Matrix where = dX.array().isNaN().cast<double>();
    if (first.size() == 0) first = where;
    EXPECT_EQ(where, first) << "always the same rows";
  }
}

TEST(Hostile, DoesWhatItSays) {
  const Matrix X = Matrix::Random(5, 2), U = Matrix::Random(5, 1);
  Matrix dX(5, 2);
  make_hostile(still(), Harm::nan, 1)->change(X, U, {}, dX);
  EXPECT_TRUE(dX.array().isNaN().all());
  make_hostile(still(), Harm::huge, 1)->change(X, U, {}, dX);
  EXPECT_EQ(dX, Matrix::Constant(5, 2, 1e300));
  EXPECT_THROW(make_hostile(still(), Harm::exception, 1)->change(X, U, {}, dX), std::runtime_error);
  make_hostile(still(), Harm::exception, 0)->change(X, U, {}, dX);
  EXPECT_EQ(dX, Matrix::Zero(5, 2));
}

}  // namespace
}  // namespace rehearse::testing
