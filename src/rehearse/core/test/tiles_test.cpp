#include "rehearse/core/tiles.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "matrix_tools.hpp"
#include "tile_tools.hpp"

namespace rehearse {
namespace {

const Index kTiledSizes[] = {1, 2, 5, 31, 32, 33, 63, 64, 70, 97, 161};

TEST(Tiles, EveryEntryHasItsOwnPlace) {
  for (const Index n : kTiledSizes) {
    std::vector<int> seen(static_cast<std::size_t>(tiles_size(n)));
    for (Index j = 0; j < n; ++j)
      for (Index i = j; i < n; ++i) EXPECT_EQ(++seen.at(static_cast<std::size_t>(entry_offset(i, j))), 1);
  }
}

TEST(Tiles, Cholesky) {
  for (const Index n : kTiledSizes) {
    const Matrix A = positive_definite(n);
    auto tiles = to_tiles(A);
    ASSERT_TRUE(tiles_cholesky(n, tiles.data()));
    const Matrix L = A.llt().matrixL();
    EXPECT_TRUE(lower_from_tiles(n, tiles).isApprox(L, 1e-12)) << n;
  }
}

TEST(Tiles, CholeskyOfAnIllConditionedMatrixIsBackwardStable) {
  const Index n = 161;
  const Vector x = normals(n, 1, 2);
  Matrix A(n, n);  // of condition 1e14
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) A(i, j) = std::exp(-std::pow(x(i) - x(j), 2) / 2) + (i == j ? 1e-12 : 0);
  auto tiles = to_tiles(A);
  ASSERT_TRUE(tiles_cholesky(n, tiles.data()));
  const Matrix L = lower_from_tiles(n, tiles);
  EXPECT_LT((L * L.transpose() - A).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Tiles, CholeskySaysWhenThereIsNone) {
  for (const Index n : {3, 40, 97}) {
    for (const double bad : {0.0, -1.0, kNaN}) {
      Matrix A = positive_definite(n);
      A(n - 1, n - 1) = bad;
      EXPECT_FALSE(tiles_cholesky(n, to_tiles(A).data())) << n << " " << bad;
    }
  }
}

TEST(Tiles, Solve) {
  for (const Index n : kTiledSizes) {
    const Matrix A = positive_definite(n), L = A.llt().matrixL();
    auto tiles = to_tiles(A);
    tiles_cholesky(n, tiles.data());
    const Vector y = normals(n, 1, 3);
    Vector x = Vector::Zero(padded(n));
    x.head(n) = y;
    tiles_solve(n, tiles.data(), x.data());
    EXPECT_TRUE(Vector(L * x.head(n)).isApprox(y, 1e-12)) << n;
    x.head(n) = y;
    tiles_solve_transposed(n, tiles.data(), x.data());
    EXPECT_TRUE(Vector(L.transpose() * x.head(n)).isApprox(y, 1e-12)) << n;
    EXPECT_TRUE(x.tail(padded(n) - n).isZero(0));
  }
}

TEST(Tiles, Inverse) {
  for (const Index n : kTiledSizes) {
    const Matrix A = positive_definite(n), L = A.llt().matrixL();
    auto tiles = to_tiles(A);
    tiles_cholesky(n, tiles.data());
    tiles_invert_factor(n, tiles.data());
    Matrix inverse = Matrix::Zero(n, n);
    for (Index j = 0; j < n; ++j)
      for (Index i = j; i < n; ++i) inverse(i, j) = tiles[static_cast<std::size_t>(transposed_offset(i, j))];
    EXPECT_TRUE((inverse * L).isIdentity(1e-12)) << n;
    tiles_multiply_inverse(n, tiles.data());
    EXPECT_TRUE(lower_from_tiles(n, tiles).isApprox(lower(A.inverse()), 1e-11)) << n;
  }
}

}  // namespace
}  // namespace rehearse
