#include "rehearse/core/linear_algebra.hpp"

#include <array>
#include <cassert>

#include "rehearse/core/tiles.hpp"

namespace rehearse {
namespace {

/// Halves by recursion down to one tile, so that nearly all work is in products.
Index half(Index n) { return (n / 2 + kTile - 1) / kTile * kTile; }

/// A lower triangle of at most kTile rows, as a tile.
class Tile {
 public:
  explicit Tile(const ConstMatrixView& A) : size_(A.rows()), entries_{} {
    Eigen::Map<Square>(entries_.data()).topLeftCorner(size_, size_).triangularView<Eigen::Lower>() = A;
  }

  bool cholesky() { return tiles_cholesky(size_, entries_.data()); }

  /// L becomes L⁻ᵀ, with zeros below the diagonal.
  Matrix inverse_transposed() {
    tiles_invert_factor(size_, entries_.data());
    return matrix();
  }

  Matrix matrix() const { return Eigen::Map<const Square>(entries_.data()).topLeftCorner(size_, size_); }

 private:
  using Square = Eigen::Matrix<double, kTile, kTile>;

  Index size_;
  std::array<double, kTile * kTile> entries_;
};

/// B ← A B and B ← B A, A square.
template <class Square>
void multiply_from_left(const Square& A, MatrixView B) {
  const Matrix copy = B;
  B.setZero();
  add_product(B, Sign::plus, A, copy);
}
template <class Square>
void multiply_from_right(MatrixView B, const Square& A) {
  const Matrix copy = B;
  B.setZero();
  add_product(B, Sign::plus, copy, A);
}

/// B ← B L⁻ᵀ.
void divide_by_transposed(const ConstMatrixView& L, MatrixView B) {
  const Index n = L.rows();
  if (n <= kTile) return multiply_from_right(B, Tile(L).inverse_transposed());
  const Index k = half(n);
  divide_by_transposed(L.topLeftCorner(k, k), B.leftCols(k));
  add_product(B.rightCols(n - k), Sign::minus, B.leftCols(k), L.bottomLeftCorner(n - k, k).transpose());
  divide_by_transposed(L.bottomRightCorner(n - k, n - k), B.rightCols(n - k));
}

}  // namespace

bool cholesky(MatrixView A) {
  assert(A.rows() == A.cols());
  const Index n = A.rows();
  if (n <= kTile) {
    Tile tile(A);
    if (!tile.cholesky()) return false;
    A.triangularView<Eigen::Lower>() = tile.matrix();
    return true;
  }
  const Index k = half(n);
  auto below = A.bottomLeftCorner(n - k, k);
  auto rest = A.bottomRightCorner(n - k, n - k);
  if (!cholesky(A.topLeftCorner(k, k))) return false;
  divide_by_transposed(A.topLeftCorner(k, k), below);
  add_product(rest, Sign::minus, below, below.transpose(), Part::lower);
  return cholesky(rest);
}

void solve_lower(const ConstMatrixView& L, MatrixView B) {
  assert(L.rows() == L.cols() && L.rows() == B.rows());
  const Index n = L.rows();
  if (n <= kTile) return multiply_from_left(Tile(L).inverse_transposed().transpose(), B);
  const Index k = half(n);
  solve_lower(L.topLeftCorner(k, k), B.topRows(k));
  add_product(B.bottomRows(n - k), Sign::minus, L.bottomLeftCorner(n - k, k), B.topRows(k));
  solve_lower(L.bottomRightCorner(n - k, n - k), B.bottomRows(n - k));
}

void solve_lower_transposed(const ConstMatrixView& L, MatrixView B) {
  assert(L.rows() == L.cols() && L.rows() == B.rows());
  const Index n = L.rows();
  if (n <= kTile) return multiply_from_left(Tile(L).inverse_transposed(), B);
  const Index k = half(n);
  solve_lower_transposed(L.bottomRightCorner(n - k, n - k), B.bottomRows(n - k));
  add_product(B.topRows(k), Sign::minus, L.bottomLeftCorner(n - k, k).transpose(), B.bottomRows(n - k));
  solve_lower_transposed(L.topLeftCorner(k, k), B.topRows(k));
}

}  // namespace rehearse
