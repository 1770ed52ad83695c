#pragma once
// The covariance matrix C of a search distribution and a square root A of it, C = A Aᵀ.

#include <Eigen/Eigenvalues>

#include "rehearse/core/types.hpp"

namespace rehearse::optim {

enum class Root {
  eigen,     // A = B D with C = B D² Bᵀ, as in Hansen 2016
  cholesky,  // A lower triangular: some 20 times cheaper. The search behaves the same (Krause 2016)
};

/// Updates are cheap (rank k) and do not touch the root; `decompose` renews it.
class Covariance {
 public:
  explicit Covariance(Index n, Root root = Root::eigen);

  Index size() const { return C_.rows(); }
  double variance(Index i) const { return C_(i, i); }

  /// C ← decay·C + P Pᵀ − N Nᵀ, P and N: n × any.
  void update(double decay, const ConstMatrixView& P, const ConstMatrixView& N);

  /// Scales coordinate i by `factor`: C_ij and C_ji by factor, C_ii by factor².
  void scale(Index i, double factor);

  /// Returns false if C is not positive definite; the old root stays then.
  bool decompose();

  // The following use C as it was at the last `decompose`.
  void colour(const ConstMatrixView& Z, MatrixView Y) const;  // Y (n × k) = A Zᵀ, Z: k × n
  void whiten(const ConstVectorView& y, VectorView z) const;  // z = C^(−1/2) y; with a Cholesky factor A⁻¹ y
  double length(const ConstVectorView& y) const;              // ‖A⁻¹ y‖, the same for every root
  auto axis(Index i) const { return A_.col(i); }
  double condition() const;           // with a Cholesky factor a lower bound
  double largest_eigenvalue() const;  // with a Cholesky factor a lower bound

 private:
  bool decompose_eigen();
  bool decompose_cholesky();

  Root root_;
  Matrix C_;  // lower triangle
  Matrix A_;
  Matrix B_;            // eigenvectors, one a column
  Vector eigenvalues_;  // ascending
  mutable Vector projected_;
  Matrix next_;           // A_ in the making
  Matrix both_, signed_;  // of an update: P and N, P and −N side by side
  Eigen::SelfAdjointEigenSolver<Matrix> solver_;
};

}  // namespace rehearse::optim
