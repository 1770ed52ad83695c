#include "rehearse/gp/cholesky.hpp"

#include <limits>

#include "rehearse/gp/blas.hpp"
#include "rehearse/gp/kernel.hpp"

namespace rehearse::gp {

double factorise(const double* scaled, Index n, Index dimensions, double noise_ratio, double* matrix) {
  use_one_blas_thread();
  const int size = static_cast<int>(n), stride = static_cast<int>(padded(n));
  for (const double jitter : kJitterLadder) {
    correlation_matrix(scaled, n, dimensions, 1 + noise_ratio + jitter, matrix);
    int info = 0;
    dpotrf_("L", &size, matrix, &stride, &info);
    if (info == 0) return jitter;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace rehearse::gp
