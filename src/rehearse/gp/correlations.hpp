#pragma once

#include "rehearse/core/types.hpp"
#include "rehearse/gp/hyperparameters.hpp"

namespace rehearse::gp {

/// exp(−½ ‖a_i − b_j‖²) (n × m) of the rows of A (n × D) and B (m × D), which are divided by the length scales. Any
/// thread.
Matrix correlations(const Matrix& A, const Matrix& B);

/// The covariance (n × m) of the latent function, without noise, at inputs A (n × D) with that at B (m × D). Any
/// thread.
Matrix covariance(const Matrix& A, const Matrix& B, const Hyperparameters& kernel);
inline Matrix covariance(const Matrix& X, const Hyperparameters& kernel) { return covariance(X, X, kernel); }

}  // namespace rehearse::gp
