#include "rehearse/core/product_kernel.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "matrix_tools.hpp"

namespace rehearse {
namespace {

/// The chain of the header, entry by entry.
Matrix chain(Matrix C, double sign, const Matrix& A, const Matrix& B) {
  for (Index j = 0; j < C.cols(); ++j)
    for (Index i = 0; i < C.rows(); ++i)
      for (Index k = 0; k < A.cols(); ++k) C(i, j) = std::fma(sign * A(i, k), B(k, j), C(i, j));
  return C;
}

Factor factor(const Matrix& A) { return {A.data(), 1, A.rows()}; }

// Sizes below, at and beyond the blocks of the kernel: 24 × 8 or 12 × 4 tiles, 120 rows, 256 inner, 512 columns.
TEST(ProductKernel, IsAChainOfFusedMultiplyAdds) {
  const Index sizes[][3] = {{1, 1, 1},      {24, 8, 3},     {25, 9, 256}, {12, 4, 257},
                            {121, 513, 40}, {250, 30, 600}, {5, 7, 0}};
  for (const auto& [m, n, k] : sizes) {
    const Matrix A = normals(m, k, 1), B = normals(k, n, 2), C = normals(m, n, 3);
    Matrix plus = C, minus = C;
    add_product(Sign::plus, Part::all, m, n, k, factor(A), factor(B), plus.data(), m);
    add_product(Sign::minus, Part::all, m, n, k, factor(A), factor(B), minus.data(), m);
    EXPECT_EQ(plus, chain(C, 1, A, B)) << m << " × " << n << " × " << k;
    EXPECT_EQ(minus, chain(C, -1, A, B)) << m << " × " << n << " × " << k;
  }
}

TEST(ProductKernel, ScalesWhatWasThere) {
  const Index m = 50, n = 9, k = 300;
  const Matrix A = normals(m, k, 1), B = normals(k, n, 2), C = normals(m, n, 3);
  Matrix scaled = C;
  add_product(Sign::plus, Part::all, m, n, k, factor(A), factor(B), scaled.data(), m, 0.7);
  EXPECT_EQ(scaled, chain(0.7 * C, 1, A, B));
}

TEST(ProductKernel, LeavesWhatIsAboveALowerTriangle) {
  for (const Index n : {1, 7, 24, 50, 130, 530}) {
    const Matrix A = normals(n, 5, 1), B = normals(5, n, 2), C = normals(n, n, 3);
    Matrix lower = C;
    add_product(Sign::plus, Part::lower, n, n, 5, factor(A), factor(B), lower.data(), n);
    Matrix expected = C;
    expected.triangularView<Eigen::Lower>() = chain(C, 1, A, B);
    EXPECT_EQ(lower, expected) << n;
  }
}

TEST(ProductKernel, LeavesWhatIsBesideABlock) {
  const Matrix A = normals(20, 6, 1), B = normals(6, 10, 2), C = normals(40, 12, 3);
  Matrix inside = C;
  add_product(Sign::plus, Part::all, 20, 10, 6, factor(A), factor(B), inside.data() + 3 + 40, 40);
  Matrix expected = C;
  expected.block(3, 1, 20, 10) = chain(C.block(3, 1, 20, 10), 1, A, B);
  EXPECT_EQ(inside, expected);
}

}  // namespace
}  // namespace rehearse
