#include "angles.hpp"

namespace rehearse::system {
namespace {

TEST(TurnedAngles, HaveNoErrorOfTheirOwn) {
  Matrix X = 3 * Matrix::Random(21, 4);
  X.col(0) *= 10;  // up to 30 rad/s
  const Matrix U = Matrix::Random(21, 2);
  for (const Index substeps : {6, 12})
    EXPECT_LT((by_kernel(X, U, substeps) - by_function(X, U, substeps)).cwiseAbs().maxCoeff(), 1e-12) << substeps;
  for (Index i = 0; i < 21; ++i) {
    const Vector x = X.row(i).transpose(), u = U.row(i).transpose();
    Vector slope(4), expected(4);
    equation_kernel().derivative(x.data(), u.data(), kStiffness.data(), slope.data());
    pendulums(x, u, kStiffness, expected);
    EXPECT_LT((slope - expected).norm(), 1e-12);
  }
}

TEST(TurnedAngles, AreAnglesWhereTheyAreFar) {
  Matrix X = Matrix::Random(21, 4);
  const Matrix U = Matrix::Random(21, 2);
  X.col(1) += 1e6 * Vector::LinSpaced(21, -1, 1);
  X.col(3) = X.col(1).reverse();
  EXPECT_LT((by_kernel(X, U, 12) - by_function(X, U, 12)).cwiseAbs().maxCoeff(), 1e-8) << "1e6 rad end at 1e-10";
}

TEST(TurnedAngles, BeyondAllReasonAreNanInTheirRowAlone) {
  const Matrix X = Matrix::Random(11, 4), U = Matrix::Random(11, 2), clean = by_kernel(X, U, 4);
  for (const Index column : {0, 2}) {
    Matrix far = X;
    far(4, column) = 1e7;
    const Matrix dX = by_kernel(far, U, 4);
    for (Index i = 0; i < 11; ++i)
      EXPECT_TRUE(i == 4 ? dX.row(i).array().isNaN().all() : dX.row(i) == clean.row(i)) << i;
  }
}

}  // namespace
}  // namespace rehearse::system
