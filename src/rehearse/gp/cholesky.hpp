#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::gp {

/// What is added to the diagonal of a covariance, times σ_f², one after the other until it factorises. The first is
/// nothing: the learned noise is usually enough. Rounding disturbs the eigenvalues of an n × n correlation matrix by
/// about n·1e-16, so the second rung is enough for n up to some 10⁵ and the others are a reserve.
inline constexpr double kJitterLadder[] = {0, 1e-10, 1e-8, 1e-6, 1e-4};

/// Cholesky factor of C + (noise_ratio + jitter)·I into `tiles` (tiles.hpp), with C the correlations of the scaled
/// inputs (kernel.hpp) and noise_ratio = σ_n²/σ_f²; unless null with the trend of z (D + 1 coordinates; kernel.hpp).
/// Unless null, `noise`, of the same tiles, is added times `noise_factor`. Returns the jitter used, or NaN if no rung
/// was enough. No allocation.
double factorise(const double* scaled, Index n, Index dimensions, double noise_ratio, double* tiles,
                 const double* z = nullptr, const double* noise = nullptr, double noise_factor = 0);

}  // namespace rehearse::gp
