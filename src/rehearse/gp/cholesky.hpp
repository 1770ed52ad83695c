#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::gp {

/// The jitter added to the diagonal of a covariance, times σ_f²; each rung is tried in turn until the matrix
/// factorises. The first is 0: the learned noise is usually enough. Rounding disturbs the eigenvalues of an n × n
/// correlation matrix by about n·1e-16, so the second rung is enough for n up to some 10⁵ and the others are a reserve.
inline constexpr double kJitterLadder[] = {0, 1e-10, 1e-8, 1e-6, 1e-4};

/// A covariance over σ_f²: correlations of the scaled inputs (kernel.hpp), noise, and perhaps more.
struct ScaledCovariance {
  const double* scaled;
  Index n, dimensions;
  double noise_ratio;             // σ_n²/σ_f²
  const double* trend = nullptr;  // inputs of the trend (dimensions + 1 coordinates; kernel.hpp), or null
  const double* noise = nullptr;  // tiles that are added times `noise_factor`, or null
  double noise_factor = 0;
};

/// Cholesky factor of the covariance with jitter into `tiles` (tiles.hpp). Returns the jitter used, or NaN if no rung
/// was enough. No allocation.
double factorise(const ScaledCovariance& covariance, double* tiles);

/// The same of a matrix over σ_f² that is given without noise (n × n, its lower triangle).
double factorise(const Matrix& covariance, double noise_ratio, double* tiles);

/// The lower triangle (n × n) and its padding, 1 on the diagonal, as tiles (tiles.hpp).
void lower_to_tiles(const Matrix& lower, double* tiles);

}  // namespace rehearse::gp
