#pragma once
// Pairs of terms under an input so narrow that the correlations hardly change over it, without the cancellation that
// sums over all pairs of points suffer there: with h_i = √scale exp(z_iᵀ A z_i) and t_ij = z_iᵀ C z_j (PairForm),
// E[c_i c_j] = h_i h_j exp(t_ij) ≈ h_i h_j (1 + t_ij) has the rank 1 + D, and the reduction of a variance is a sum of
// squares. The rest is of the order t².

#include "rehearse/moments/moment_kernel.hpp"
#include "rehearse/moments/moment_term.hpp"

namespace rehearse::moments {

/// A term under an input.
struct NarrowSide {
  const MomentTerm& term;
  const Matrix& points;  // less the mean of the input, at least n rows
  Matrix form;           // D × D, A
  Matrix form_change;  // D × D: A less that of the mean's correlations q_i = scale exp(z_iᵀ (A − form_change) z_i)
  double scale_change;  // ln of √scale over the mean's
  Vector correlations;  // n, the mean's, E[c_i]
};

/// The largest |t_ij| that leaves out less than rounding would add to the sums of all pairs.
double narrow_limit(const MomentTerm& a, const MomentTerm& b);

/// True if a bound shows that no |t_ij| exceeds the limit; forward_a, forward_b: PairForm's A plus ½ diag ℓ⁻², of a and
/// of b. A few operations where the first points exceed it.
bool crosses_within(const Matrix& points_a, const ConstMatrixView& forward_a, const Matrix& points_b,
                    const ConstMatrixView& forward_b, double limit);

/// cov[f_a, f_b], less σ_f² where both are one GP, whose variance is then ≥ 0; and what PairSums has (a.first,
/// a.second, b.first, b.second, cross), scale included. `own`: both are one function with an uncertainty.
double narrow_sums(const NarrowSide& a, const NarrowSide& b, const Matrix& C, double log_scale, bool own,
                   PairSums& sums);

}  // namespace rehearse::moments
