#pragma once
// The covariance matrix C of a search distribution and its symmetric square root.

#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// C (n × n) = B D² Bᵀ. Updates are cheap (rank k) and do not touch the decomposition; `decompose` renews it.
class Covariance {
 public:
  explicit Covariance(Index n);

  Index size() const { return C_.rows(); }
  double variance(Index i) const { return C_(i, i); }

  /// C ← decay·C + P Pᵀ − N Nᵀ, P and N: n × any.
  void update(double decay, const ConstMatrixView& P, const ConstMatrixView& N);

  /// Scales coordinate i by `factor`: C_ij and C_ji by factor, C_ii by factor².
  void scale(Index i, double factor);

  /// Returns false if C has an eigenvalue that is not above zero; the old decomposition stays then.
  bool decompose();

  // The following use C as it was at the last `decompose`.
  void colour(const ConstMatrixView& Z, MatrixView Y) const;  // Y (n × k) = B D Zᵀ, Z: k × n
  void whiten(const ConstVectorView& y, VectorView z) const;  // z = C^(−1/2) y = B D⁻¹ Bᵀ y
  double length(const ConstVectorView& y) const;              // ‖C^(−1/2) y‖
  auto axis(Index i) const { return BD_.col(i); }             // d_i b_i
  double condition() const { return eigenvalues_(size() - 1) / eigenvalues_(0); }
  double largest_eigenvalue() const { return eigenvalues_(size() - 1); }

 private:
  Matrix C_;            // lower triangle
  Matrix B_;            // eigenvectors, one a column
  Matrix BD_;           // scaled by the square roots of the eigenvalues
  Vector eigenvalues_;  // ascending
  mutable Vector projected_;
  Matrix vectors_;  // the next B_
  Vector values_;
  std::vector<double> work_;
  std::vector<int> iwork_;
};

}  // namespace rehearse::optim
