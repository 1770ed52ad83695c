#pragma once
// Products and triangular factors of dense matrices, for use where Eigen's, which are compiled for any x86-64, are too
// slow: some 8 times with AVX-512. The same bits on every processor and thread. Sizes are the caller's to get right
// (asserted). The part above the diagonal of a lower triangular matrix is neither read nor written.

#include <cassert>

#include "rehearse/core/product_kernel.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse {

/// The factor that a matrix, a block of one, or the transpose of these is.
template <class M>
Factor factor(const M& A) {
  static_assert((M::Flags & Eigen::DirectAccessBit) != 0, "a factor of a product stands in memory");
  return {A.data(), A.rowStride(), A.colStride()};
}

/// C ← scale·C ± A B. C must not be a factor.
template <class A, class B>
void add_product(MatrixView C, Sign sign, const A& a, const B& b, Part part = Part::all, double scale = 1) {
  assert(C.rows() == a.rows() && C.cols() == b.cols() && a.cols() == b.rows());
  add_product(sign, part, C.rows(), C.cols(), a.cols(), factor(a), factor(b), C.data(), C.outerStride(), scale);
}

/// A B.
template <class A, class B>
Matrix product(const A& a, const B& b) {
  Matrix C = Matrix::Zero(a.rows(), b.cols());
  add_product(C, Sign::plus, a, b);
  return C;
}

/// Lower triangular A becomes L with A = L Lᵀ. False if A is not positive definite or not finite; then A is undefined.
bool cholesky(MatrixView A);

/// B ← L⁻¹ B and B ← L⁻ᵀ B, L lower triangular.
void solve_lower(const ConstMatrixView& L, MatrixView B);
void solve_lower_transposed(const ConstMatrixView& L, MatrixView B);

}  // namespace rehearse
