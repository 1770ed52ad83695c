#include "rehearse/gp/kernel.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "naive.hpp"
#include "rehearse/core/test/tile_tools.hpp"

namespace rehearse::gp {
namespace {

std::vector<double> scaled(const Matrix& X) {
  std::vector<double> out(static_cast<std::size_t>(padded(X.rows()) * X.cols()));
  const Vector ones = Vector::Ones(X.cols());
  scale_inputs(X.data(), X.rows(), X.cols(), ones.data(), out.data());
  return out;
}

TEST(Kernel, CorrelationMatrix) {
  for (const Index n : {1, 2, 7, 8, 9, 31, 33, 64, 100}) {
    const Matrix X = naive::normals(n, 5, 1);
    std::vector<double> tiles(static_cast<std::size_t>(tiles_size(n)));
    correlation_matrix(scaled(X).data(), n, 5, 3.5, tiles.data());
    Matrix expected = naive::correlations(X, X);
    expected.diagonal().setConstant(3.5);
    EXPECT_TRUE(lower_from_tiles(n, tiles).isApprox(lower(expected), 1e-14)) << n;
  }
}

TEST(Kernel, GradientSums) {
  for (const Index n : {1, 5, 8, 41, 97}) {
    const Index D = 3;
    const Matrix X = naive::normals(n, D, 2), inverse = naive::normals(n, n, 3);
    Vector b = Vector::Zero(padded(n)), sums(8 * (D + 1)), expected = Vector::Zero(D + 1);
    b.head(n) = naive::normals(n, 1, 4);
    const Matrix C = naive::correlations(X, X);
    for (Index j = 0; j < n; ++j) {
      for (Index i = j + 1; i < n; ++i) {
        const double w = (b(i) * b(j) - inverse(i, j)) * C(i, j);
        expected.head(D) += w * (X.row(i) - X.row(j)).cwiseAbs2().transpose();
        expected(D) += w;
      }
    }
    gradient_sums(scaled(X).data(), n, D, b.data(), to_tiles(inverse).data(), sums.data());
    EXPECT_LT((sums.head(D + 1) - expected).norm(), 1e-12 * (1 + expected.norm())) << n;
  }
}

}  // namespace
}  // namespace rehearse::gp
