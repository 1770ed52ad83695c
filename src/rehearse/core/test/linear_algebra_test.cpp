#include "rehearse/core/linear_algebra.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "matrix_tools.hpp"

namespace rehearse {
namespace {

const Index kFactorSizes[] = {1, 2, 7, 31, 32, 33, 64, 97, 161, 290};

Matrix lower_triangle(Index n) { return positive_definite(n).llt().matrixL(); }

/// The matrix with NaN above the diagonal, which must not be read.
Matrix hidden_above(Matrix A) {
  A.triangularView<Eigen::StrictlyUpper>().setConstant(kNaN);
  return A;
}

TEST(LinearAlgebra, FactorsStandAsTheyAreOrTransposed) {
  const Matrix A = normals(40, 13, 1), B = normals(13, 17, 2);
  const Matrix expected = A * B, At = A.transpose(), Bt = B.transpose();
  EXPECT_TRUE(product(A, B).isApprox(expected, 1e-14));
  EXPECT_EQ(product(At.transpose(), B), product(A, B));
  EXPECT_EQ(product(A, Bt.transpose()), product(A, B));
  EXPECT_EQ(product(At.transpose(), Bt.transpose()), product(A, B));
  EXPECT_EQ(product(A.middleRows(3, 20), B.rightCols(5)), product(A, B).block(3, 12, 20, 5));
}

TEST(LinearAlgebra, Cholesky) {
  for (const Index n : kFactorSizes) {
    Matrix A = hidden_above(positive_definite(n));
    ASSERT_TRUE(cholesky(A));
    EXPECT_TRUE(Matrix(A.triangularView<Eigen::Lower>()).isApprox(lower_triangle(n), 1e-12)) << n;
    EXPECT_EQ(A.triangularView<Eigen::StrictlyUpper>().toDenseMatrix().array().isNaN().count(), n * (n - 1) / 2);
  }
}

TEST(LinearAlgebra, CholeskyOfABlock) {
  Matrix A = Matrix::Constant(60, 60, 7);
  A.block(5, 9, 40, 40) = positive_definite(40);
  ASSERT_TRUE(cholesky(A.block(5, 9, 40, 40)));
  EXPECT_TRUE(Matrix(A.block(5, 9, 40, 40).triangularView<Eigen::Lower>()).isApprox(lower_triangle(40), 1e-12));
  A.block(5, 9, 40, 40).setConstant(7);
  EXPECT_EQ(A, Matrix::Constant(60, 60, 7));
}

TEST(LinearAlgebra, CholeskySaysWhenThereIsNone) {
  for (const Index n : {3, 40, 97})
    for (const double bad : {0.0, -1.0, kNaN}) {
      Matrix A = positive_definite(n);
      A(n - 1, n - 1) = bad;
      EXPECT_FALSE(cholesky(A)) << n << " " << bad;
    }
}

TEST(LinearAlgebra, Solve) {
  for (const Index n : kFactorSizes) {
    const Matrix L = lower_triangle(n), hidden = hidden_above(L), B = normals(n, 9, 4);
    Matrix X = B;
    solve_lower(hidden, X);
    EXPECT_TRUE(Matrix(L * X).isApprox(B, 1e-12)) << n;
    X = B;
    solve_lower_transposed(hidden, X);
    EXPECT_TRUE(Matrix(L.transpose() * X).isApprox(B, 1e-12)) << n;
  }
}

}  // namespace
}  // namespace rehearse
