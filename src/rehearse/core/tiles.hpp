#pragma once
// Symmetric and triangular n × n matrices, kept as the lower triangle of square tiles that fit in the first-level
// cache. OpenBLAS 0.3.21 inverts with 12 GFLOP/s at n = 200 and 25 at 1000 where its products reach 60, and fits of
// Gaussian processes spend their time there; these routines stay near 60. Vectorised by Highway; raw pointers; may run
// concurrently; the same bits on every thread and processor.

#include <cstddef>

namespace rehearse {

using Size = std::ptrdiff_t;

/// Rows and columns of a tile, which is column-major.
constexpr Size kTile = 32;
constexpr Size tile_count(Size n) { return (n + kTile - 1) / kTile; }

/// Arrays over the training points are padded to whole tiles.
constexpr Size padded(Size n) { return tile_count(n) * kTile; }

/// The offset of tile (i, j), i ≥ j, and the number of doubles in all tiles.
constexpr Size tile_offset(Size i, Size j) { return (i * (i + 1) / 2 + j) * kTile * kTile; }
constexpr Size tiles_size(Size n) { return tile_offset(tile_count(n), 0); }

/// The offset of the entry (row, column), row ≥ column.
constexpr Size entry_offset(Size row, Size column) {
  return tile_offset(row / kTile, column / kTile) + column % kTile * kTile + row % kTile;
}

/// A = L Lᵀ: the lower triangle of A becomes L, what is above it undefined. False if A is not positive definite.
bool tiles_cholesky(Size n, double* tiles);

/// x ← L⁻¹ x and x ← L⁻ᵀ x; x: padded(n), or as many columns of that length.
void tiles_solve(Size n, const double* tiles, double* x, Size columns = 1);
void tiles_solve_transposed(Size n, const double* tiles, double* x);

/// L becomes L⁻¹, each tile transposed: entry (row, column) of L⁻¹ is at transposed_offset(row, column).
void tiles_invert_factor(Size n, double* tiles);
constexpr Size transposed_offset(Size row, Size column) {
  return tile_offset(row / kTile, column / kTile) + row % kTile * kTile + column % kTile;
}

/// The result of tiles_invert_factor becomes L⁻ᵀ L⁻¹ = A⁻¹; its lower triangle is defined.
void tiles_multiply_inverse(Size n, double* tiles);

}  // namespace rehearse
