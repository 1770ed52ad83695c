#pragma once
// The matrices of moment matching that depend on the input's covariance and on length scales alone. For
// moment_matching.cpp.

#include <cmath>

#include <Eigen/Cholesky>

#include "rehearse/moments/gaussian.hpp"
#include "rehearse/moments/moment_kernel.hpp"
#include "rehearse/moments/moment_term.hpp"

namespace rehearse::moments {

inline std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// A matrix and a vector that live on the stack, of at most kMostMomentInputs rows.
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostMomentInputs, kMostMomentInputs>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostMomentInputs, 1>;

/// Kept away from 0 and infinity, beyond which an input is as good as irrelevant or all points are far.
inline SmallVector inverse_squares(const Vector& log_lengths) {
  return (-2 * log_lengths).array().exp().max(1e-200).min(1e200);
}

/// (I + D^½ s D^½)⁻¹ for a diagonal D, with 1/√det of what is inverted. Not ok if that is not positive definite.
struct Shrinkage {
  Shrinkage(const Matrix& s, const SmallVector& diagonal) : root(diagonal.cwiseSqrt()) {
    const Index D = s.rows();
    scaled = root.asDiagonal() * s * root.asDiagonal();
    const Eigen::LLT<Small> llt(Small::Identity(D, D) + scaled);
    inverse = llt.solve(Small::Identity(D, D));
    scale = 1 / llt.matrixLLT().diagonal().prod();
    ok = llt.info() == Eigen::Success && inverse.allFinite() && std::isfinite(scale);
  }
  SmallVector root;
  Small scaled, inverse;
  double scale;
  bool ok;
};

/// The mean of a term: B⁻¹ = (s + Λ)⁻¹, Λ = diag(ℓ²).
struct MeanGeometry {
  MeanGeometry(const Gaussian& input, const MomentTerm& term)
      : shrinkage(input.covariance, inverse_squares(term.log_lengths)),
        inverse(shrinkage.root.asDiagonal() * shrinkage.inverse * shrinkage.root.asDiagonal()) {}
  Shrinkage shrinkage;
  Small inverse;
};

/// Matrices of the pair of terms a and b: with A and B the diagonal inverse squared lengths and S = A + B,
/// L_ij = exp(−½ z_iᵀ A z_i − ½ z_jᵀ B z_j + v_ijᵀ Q v_ij), v_ij = A z_i + B z_j, and E[c_i c_j] = scale · L_ij
/// (Deisenroth 2010, section 2.3).
struct PairGeometry {
  PairGeometry(const Gaussian& input, const MomentTerm& a, const MomentTerm& b)
      : A(inverse_squares(a.log_lengths)), B(inverse_squares(b.log_lengths)), shrinkage(input.covariance, A + B) {
    const auto& root = shrinkage.root;
    const auto inverse_root = root.cwiseInverse();
    Small Q2 = shrinkage.inverse * shrinkage.scaled;  // symmetric but for rounding
    Q2 = (Q2 + Q2.transpose()).eval() / 2;
    Q = inverse_root.asDiagonal() * Q2 * inverse_root.asDiagonal() / 2;
    back = root.asDiagonal() * shrinkage.inverse * inverse_root.asDiagonal();
    K = root.asDiagonal() * shrinkage.inverse * root.asDiagonal();
    ok = shrinkage.ok && Q.allFinite() && back.allFinite();
  }

  /// Σ_ij G_ij v_ij v_ijᵀ from Σ G z_i z_iᵀ, Σ G z_j z_jᵀ and Σ G z_i z_jᵀ.
  Small spread(const Small& aa, const Small& bb, const Small& ab) const {
    const Small mixed = A.asDiagonal() * ab * B.asDiagonal();
    return A.asDiagonal() * aa * A.asDiagonal() + B.asDiagonal() * bb * B.asDiagonal() + mixed + mixed.transpose();
  }

  SmallVector A, B;
  Shrinkage shrinkage;
  Small Q;     // ½ (s⁻¹ + S)⁻¹
  Small back;  // (I + S s)⁻¹
  Small K;     // (s + S⁻¹)⁻¹
  bool ok;
};

}  // namespace rehearse::moments
