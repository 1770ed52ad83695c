#include "rehearse/gp/cholesky.hpp"

#include <limits>

#include "rehearse/gp/kernel.hpp"

namespace rehearse::gp {

double factorise(const double* scaled, Index n, Index dimensions, double noise_ratio, double* tiles, const double* z,
                 const double* noise, double noise_factor) {
  for (const double jitter : kJitterLadder) {
    correlation_matrix(scaled, n, dimensions, 1 + noise_ratio + jitter, tiles);
    if (z) add_trend(z, n, dimensions + 1, tiles);
    if (noise)
      for (Size i = 0; i < tiles_size(n); ++i) tiles[i] += noise_factor * noise[i];
    if (tiles_cholesky(n, tiles)) return jitter;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace rehearse::gp
