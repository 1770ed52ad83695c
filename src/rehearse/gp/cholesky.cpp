#include "rehearse/gp/cholesky.hpp"

#include <algorithm>

#include "rehearse/gp/kernel.hpp"

namespace rehearse::gp {

double factorise(const ScaledCovariance& c, double* tiles) {
  for (const double jitter : kJitterLadder) {
    correlation_matrix(c.scaled, c.n, c.dimensions, 1 + c.noise_ratio + jitter, tiles);
    if (c.trend) add_trend(c.trend, c.n, c.dimensions + 1, tiles);
    if (c.noise)
      for (Size i = 0; i < tiles_size(c.n); ++i) tiles[i] += c.noise_factor * c.noise[i];
    if (tiles_cholesky(c.n, tiles)) return jitter;
  }
  return kNaN;
}

double factorise(const Matrix& covariance, double noise_ratio, double* tiles) {
  for (const double jitter : kJitterLadder) {
    lower_to_tiles(covariance, tiles);
    for (Index i = 0; i < covariance.rows(); ++i) tiles[entry_offset(i, i)] += noise_ratio + jitter;
    if (tiles_cholesky(covariance.rows(), tiles)) return jitter;
  }
  return kNaN;
}

void lower_to_tiles(const Matrix& lower, double* tiles) {
  std::fill(tiles, tiles + tiles_size(lower.rows()), 0.0);
  for (Index i = lower.rows(); i < padded(lower.rows()); ++i) tiles[entry_offset(i, i)] = 1;
  for (Index j = 0; j < lower.cols(); ++j)
    for (Index i = j; i < lower.rows(); ++i) tiles[entry_offset(i, j)] = lower(i, j);
}

}  // namespace rehearse::gp
