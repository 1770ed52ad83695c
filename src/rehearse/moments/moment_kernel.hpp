#pragma once
// The loops of moment matching over training points, vectorised by Highway for the processor found at run time: nearly
// all of its time. Raw pointers; may run concurrently; the same bits on every thread.
//
// Points are columns of `stride` doubles, one a dimension, the padding zero; D × D matrices are column-major.

#include "rehearse/core/types.hpp"

namespace rehearse::moments {

/// Columns over n points are padded to this many doubles.
constexpr Index moment_stride(Index n) { return (n + 7) / 8 * 8; }

/// Points less the mean of the input, with the weights of a network on them (0 in the padding).
struct WeightedPoints {
  const double* points;  // D columns
  const double* weights;
  Index size, stride;
};

/// q_i = factor exp(−½ z_iᵀ P z_i); weights are not used.
void mean_correlations(const WeightedPoints& a, Index D, const double* P, double factor, double* q);

/// Σ_i g_i, Σ_i g_i z_i (D) and Σ_i g_i z_i z_iᵀ (D × D, symmetric).
struct PointSums {
  double total;
  double* first;
  double* second;  // may be null
};
void point_sums(const WeightedPoints& a, Index D, PointSums& sums);

/// L_ij = exp(z_iᵀ A z_i + z_jᵀ B z_j + z_iᵀ C z_j) for the points i of `a` and j of `b`.
struct PairForm {
  const double *A, *B, *C;  // D × D; A and B symmetric
};

/// Sums of G_ij = w_i w_j L_ij, or W_ij L_ij with a symmetric W, of which pair_weights() makes `weights`.
struct PairSums {
  PointSums a;    // of Σ_j G_ij over i
  PointSums b;    // of Σ_i G_ij over j; b.first null: not wanted, as those of a network with itself are those of a
  double* cross;  // Σ_ij G_ij z_i z_jᵀ, D × D
  double* rows;   // null or D + 1 columns of a.stride: Σ_j w_j L_ij, Σ_j w_j L_ij z_j; not with W
};

/// weights: null, or for a network with itself what pair_weights() gave. scratch: pair_scratch(b) doubles.
void pair_sums(const WeightedPoints& a, const WeightedPoints& b, Index D, const PairForm& form, const double* weights,
               PairSums& sums, double* scratch);
constexpr Index pair_scratch(const WeightedPoints& b) { return 9 * b.stride; }

/// W in columns of its stride, padded with zeros: blocks of 8 × 8 below the diagonal as they are, those on it halved,
/// those above it left out.
Matrix pair_weights(const Matrix& W);

/// The most dimensions that the loops take.
constexpr Index kMostMomentInputs = 32;

}  // namespace rehearse::moments
