#pragma once
// The elementwise loops of the evidence, vectorised by Highway for the processor found at run time. Raw pointers; may
// run concurrently.
//
// Correlations are c(a, b) = exp(−½‖a − b‖²) of inputs scaled by 1/ℓ, by direct differences: expanding the square
// would lose the last digits of close points, which the posterior variance needs. Those below e^−80 are set to 0:
// their products would be subnormal numbers, which are slow.

#include "rehearse/gp/tiles.hpp"

namespace rehearse::gp {

/// scaled (D × padded(n) in all) from unit inputs (n × D, column-major) and factors (D): for each tile of points its
/// coordinates, dimension by dimension. The padding is so far away that its correlations are 0.
void scale_inputs(const double* unit, Size n, Size dimensions, const double* factors, double* scaled);

/// The correlations of the scaled inputs in tiles, with `diagonal` on the diagonal.
void correlation_matrix(const double* scaled, Size n, Size dimensions, double diagonal, double* tiles);

/// With w_ij = (b_i b_j − inverse_ij) c_ij, sums over the strict lower triangle i > j: sums[d] of w_ij (a_id − a_jd)²
/// for each dimension d, and sums[D] of w_ij. b: padded(n), zero in the padding; inverse: in tiles;
/// sums: 8 (D + 1), the rest of it scratch.
void gradient_sums(const double* scaled, Size n, Size dimensions, const double* b, const double* inverse, double* sums);

}  // namespace rehearse::gp
