#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::gp {

/// exp(−½ ‖a_i − b_j‖²) (n × m) of the rows of A (n × D) and B (m × D), which are divided by the length scales. Any
/// thread.
Matrix correlations(const Matrix& A, const Matrix& B);

}  // namespace rehearse::gp
