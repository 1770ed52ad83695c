#include "rehearse/optim/covariance.hpp"

#include <cmath>
#include <cstdlib>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace rehearse::optim {
namespace {

/// The same random matrix in both forms, and as a plain one.
struct Fixture {
  explicit Fixture(Root root) : covariance(6, root) {
    std::srand(1);
    const Matrix P = Matrix::Random(6, 3), N = 0.1 * Matrix::Random(6, 2);
    covariance.update(0.5, P, N);
    covariance.scale(2, 3);
    dense = 0.5 * Matrix::Identity(6, 6) + P * P.transpose() - N * N.transpose();
    dense.row(2) *= 3;
    dense.col(2) *= 3;
    EXPECT_TRUE(covariance.decompose());
  }
  Covariance covariance;
  Matrix dense;
};

TEST(Covariance, BothRootsAreRoots) {
  for (const Root root : {Root::eigen, Root::cholesky}) {
    const Fixture f(root);
    Matrix A(6, 6);
    f.covariance.colour(Matrix::Identity(6, 6), A);
    EXPECT_LT((A * A.transpose() - f.dense).norm(), 1e-12);
    EXPECT_LT((A.col(4) - f.covariance.axis(4)).norm(), 1e-12);
    EXPECT_DOUBLE_EQ(f.covariance.variance(2), f.dense(2, 2));
    EXPECT_GE(f.covariance.condition(), 1);
  }
}

TEST(Covariance, WhitensAndMeasures) {
  const Vector y = Vector::LinSpaced(6, -1, 2);
  for (const Root root : {Root::eigen, Root::cholesky}) {
    const Fixture f(root);
    const double expected = std::sqrt(y.dot(f.dense.inverse() * y));
    Vector z(6);
    f.covariance.whiten(y, z);
    EXPECT_NEAR(z.norm(), expected, 1e-12);
    EXPECT_NEAR(f.covariance.length(y), expected, 1e-12);
  }
}

TEST(Covariance, KeepsItsRootWhenNotPositiveDefinite) {
  for (const Root root : {Root::eigen, Root::cholesky}) {
    Covariance covariance(3, root);
    covariance.update(1, Matrix(3, 0), Matrix::Constant(3, 1, 2));
    EXPECT_FALSE(covariance.decompose());
    EXPECT_EQ(covariance.length(Vector::Ones(3)), std::sqrt(3.0));
  }
}

}  // namespace
}  // namespace rehearse::optim
