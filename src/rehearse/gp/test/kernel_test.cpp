#include "rehearse/gp/kernel.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "naive.hpp"

namespace rehearse::gp {
namespace {

Matrix scaled(const Matrix& X) {
  Matrix S(padded(X.rows()), X.cols());
  const std::vector<double> ones(static_cast<std::size_t>(X.cols()), 1);
  scale_inputs(X.data(), X.rows(), X.cols(), ones.data(), S.data());
  return S;
}

Matrix correlations(const Matrix& A, const Matrix& B) {
  return naive::covariance(A, B, {.log_lengths = Vector::Zero(A.cols()), .log_signal = 0, .log_noise = 0});
}

TEST(Kernel, PaddingHoldsAllRowsAndAvoidsPowersOfTwo) {
  for (Index n = 1; n < 2000; ++n) {
    EXPECT_GE(padded(n), n);
    EXPECT_LE(padded(n), n + 15);
    EXPECT_EQ(padded(n) % 8, 0);
    EXPECT_NE(padded(n) % 64, 0);
  }
}

TEST(Kernel, CorrelationMatrix) {
  for (const Index n : {1, 2, 7, 8, 9, 31, 33, 64, 100}) {
    const Matrix X = naive::normals(n, 5, 1);
    Matrix K(padded(n), n);
    correlation_matrix(scaled(X).data(), n, 5, 3.5, K.data());
    Matrix expected = correlations(X, X);
    expected.diagonal().setConstant(3.5);
    const Matrix lower = K.topRows(n).triangularView<Eigen::Lower>();
    EXPECT_TRUE(lower.isApprox(Matrix(expected.triangularView<Eigen::Lower>()), 1e-14)) << n;
  }
}

TEST(Kernel, GradientSums) {
  for (const Index n : {1, 5, 8, 41, 97}) {
    const Index D = 3;
    const Matrix X = naive::normals(n, D, 2), inverse = naive::normals(padded(n), n, 3);
    Vector b = Vector::Zero(padded(n)), sums(8 * (D + 1)), expected = Vector::Zero(D + 1);
    b.head(n) = naive::normals(n, 1, 4);
    const Matrix C = correlations(X, X);
    for (Index j = 0; j < n; ++j) {
      for (Index i = j + 1; i < n; ++i) {
        const double w = (b(i) * b(j) - inverse(i, j)) * C(i, j);
        expected.head(D) += w * (X.row(i) - X.row(j)).cwiseAbs2().transpose();
        expected(D) += w;
      }
    }
    gradient_sums(scaled(X).data(), n, D, b.data(), inverse.data(), sums.data());
    EXPECT_LT((sums.head(D + 1) - expected).norm(), 1e-12 * (1 + expected.norm())) << n;
  }
}

}  // namespace
}  // namespace rehearse::gp
