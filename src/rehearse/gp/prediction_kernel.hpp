#pragma once
// The loops of a prediction (correlations as in kernel.hpp), vectorised over the rows to predict, so that each row goes
// through the same operations whatever its place among them and however many there are. Raw pointers; may run
// concurrently.

#include "rehearse/core/tiles.hpp"

namespace rehearse::gp {

/// Rows predicted together: many, so that L⁻¹ is read seldom from memory, but few enough that their correlations with
/// 1000 training points stay in a second-level cache of 2 MiB.
constexpr Size kChunk = 128;

/// Queries go through the loops in groups of at most so many, of which kChunk is a multiple.
constexpr Size kGroup = 32;

/// Points of a kernel: scaled inputs, and unless null the coordinates z of the trend (kernel.hpp). Those of
/// training points are n × D and n × (D + 1), row by row; those of queries D × kChunk and
/// (D + 1) × kChunk, too.
struct KernelPoints {
  const double* scaled;
  const double* z = nullptr;
};

/// Covariances over σ_f² of `rows` ≤ kChunk queries (the rest of their last group must be finite) with n training
/// points. means[q] = Σ_i c_qi weights_i without the trend, which is one quadratic form of z for all points together.
/// Unless null, `columns` (n × kChunk) receives c, with the trend, as `triangular_norms` reads it; means: kChunk. All
/// points have a trend, or none.
void correlate(KernelPoints points, Size n, Size dimensions, const double* weights, KernelPoints queries, Size rows,
               double* columns, double* means);

/// means[q] += uᵀ A u, u = (1, x_q), for `rows` ≤ kChunk queries x_q; form: the lower triangle of A row by row, entries
/// beside the diagonal doubled; queries: dimensions × kChunk, row by row.
void add_quadratic_form(const double* form, Size dimensions, const double* queries, Size rows, double* means);

/// Rows of a lower triangular matrix that are multiplied together, interleaved.
constexpr Size kPanel = 6;
constexpr Size packed_size(Size n) {
  const Size panels = (n + kPanel - 1) / kPanel;
  return kPanel * kPanel * panels * (panels + 1) / 2;
}

/// packed (packed_size(n)) from what tiles_invert_factor left, and back again.
void pack_inverse_factor(const double* tiles, Size n, double* packed);
double packed_entry(const double* packed, Size row, Size column);

/// norms[q] = ‖L c_q‖² for the first `rows` columns that `correlate` wrote; norms: kChunk.
void triangular_norms(const double* packed, Size n, const double* columns, Size rows, double* norms);

/// norms as `triangular_norms`, of the same bits, and `solved` = Lᵀ L c, laid out as `columns`.
void triangular_solutions(const double* packed, Size n, const double* columns, Size rows, double* norms,
                          double* solved);

/// Numbers of n training points for each query, laid out as `columns`. Scratch: the sums below overwrite them.
struct PointColumns {
  double* correlations;      // as `correlate` wrote them, with the trend if there is one
  double* solved = nullptr;  // v, as `triangular_solutions` wrote it; null: `mean` alone is wanted
  double* trends = nullptr;  // memory; null without a trend
};

/// Sums over n training points i for each query q, with c_qi the correlation without the trend.
struct PointSums {
  double* mean;      // dimensions × kChunk: Σ_i weights_i c_qi (x_id − x_qd)
  double* variance;  // the same of Σ_i v_qi c_qi (x_id − x_qd)
  double* trend;     // (1 + dimensions) × kChunk: Σ_i v_qi (z_i · z_q) z_id
};
void sum_slopes(KernelPoints points, Size n, Size dimensions, const double* weights, KernelPoints queries, Size rows,
                PointColumns columns, PointSums sums);

}  // namespace rehearse::gp
