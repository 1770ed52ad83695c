#pragma once
// The elementwise loops, vectorised by Highway for the processor found at run time. Raw pointers, column-major. All
// arrays over the n training points are padded to padded(n) rows, so that no loop has a tail. May run concurrently.
//
// Correlations are c(a, b) = exp(−½‖a − b‖²) of inputs scaled by 1/ℓ, by direct differences: expanding the square
// would lose the last digits of close points, which the posterior variance needs. Those below e^−80 are set to 0:
// their products would be subnormal numbers, which are slow.

#include <cstddef>

namespace rehearse::gp {

using Size = std::ptrdiff_t;

/// Whole vectors, and no stride of a multiple of 512 bytes, which would map all columns to the same cache sets.
constexpr Size padded(Size n) { return (n + 7) / 8 * 8 % 64 == 0 ? (n + 7) / 8 * 8 + 8 : (n + 7) / 8 * 8; }

/// scaled (padded(n) × D) from unit inputs (n × D) and factors (D): the padding is so far away that its correlations
/// are 0.
void scale_inputs(const double* unit, Size n, Size dimensions, const double* factors, double* scaled);

/// The lower triangle of the correlations of the scaled inputs into matrix (padded(n) × n), with `diagonal` on it.
/// Entries above the diagonal and in the padding are undefined.
void correlation_matrix(const double* scaled, Size n, Size dimensions, double diagonal, double* matrix);

/// With w_ij = (b_i b_j − inverse_ij) c_ij, sums over the strict lower triangle i > j: sums[d] of w_ij (a_id − a_jd)²
/// for each dimension d, and sums[D] of w_ij. b: padded(n), zero in the padding; inverse: padded(n) × n;
/// sums: 8 (D + 1), the rest of it scratch.
void gradient_sums(const double* scaled, Size n, Size dimensions, const double* b, const double* inverse, double* sums);

}  // namespace rehearse::gp
