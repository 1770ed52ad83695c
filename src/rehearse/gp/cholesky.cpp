#include "rehearse/gp/cholesky.hpp"

#include <limits>

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
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace rehearse::gp
