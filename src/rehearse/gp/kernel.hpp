#pragma once
// The elementwise loops of the evidence, vectorised by Highway for the processor found at run time. Raw pointers; may
// run concurrently.
//
// Correlations are c(a, b) = exp(−½‖a − b‖²) of inputs scaled by 1/ℓ, by direct differences: expanding the square
// would lose the last digits of close points, which the posterior variance needs. Those below e^−80 are set to 0:
// their products would be subnormal numbers, which are slow.

#include "rehearse/core/tiles.hpp"

namespace rehearse::gp {

/// scaled (D × padded(n) in all) from unit inputs (n × D, column-major) and factors (D): for each tile of points its
/// coordinates, dimension by dimension. The padding is so far away that its correlations are 0.
void scale_inputs(const double* unit, Size n, Size dimensions, const double* factors, double* scaled);

/// z (dimensions + 1 × padded(n), as `scaled`, 0 in the padding) from unit inputs, whose `centers` and `half_ranges`
/// are given, and the factors of the trend (1 + dimensions): z_0 is the first of them, z_d the input itself times the
/// next.
void trend_inputs(const double* unit, const double* centers, const double* half_ranges, Size n, Size dimensions,
                  const double* factors, double* z);

/// The correlations of the scaled inputs in tiles, with `diagonal` on the diagonal.
void correlation_matrix(const double* scaled, Size n, Size dimensions, double diagonal, double* tiles);

/// Adds (z_i · z_j)² to the tiles. z: (D × padded(n) in all) as `scaled`, but 0 in the padding.
void add_trend(const double* z, Size n, Size dimensions, double* tiles);

/// With w_ij = (b_i b_j − inverse_ij) (z_i · z_j), sums over all i and j of w_ij z_id z_jd for each dimension d:
/// sums[d]. b, inverse, sums: as below, of `dimensions` numbers.
void trend_gradient_sums(const double* z, Size n, Size dimensions, const double* b, const double* inverse,
                         double* sums);

/// With w_ij = (b_i b_j − inverse_ij) c_ij, sums over the strict lower triangle i > j: sums[d] of w_ij (a_id − a_jd)²
/// for each dimension d, and sums[D] of w_ij. b: padded(n), zero in the padding; inverse: in tiles;
/// sums: 8 (D + 1), the rest of it scratch.
void gradient_sums(const double* scaled, Size n, Size dimensions, const double* b, const double* inverse, double* sums);

}  // namespace rehearse::gp
