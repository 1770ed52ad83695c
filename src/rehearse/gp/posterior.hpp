#pragma once

#include <vector>

#include "rehearse/gp/hyperparameters.hpp"
#include "rehearse/gp/inputs.hpp"

namespace rehearse::gp {

class Workspace;

/// E independent GPs conditioned on the same inputs (Rasmussen 2006, eqs 2.25 and 2.26), made for batches. Immutable;
/// const methods may run concurrently. A row's result has the same bits on any thread and whatever rows come with it.
/// No allocation after a thread's first call.
class Posterior {
 public:
  /// Y: n × E targets; one set of hyperparameters per output. Throws InvalidInput on wrong sizes or values that are
  /// not finite. The jitter ladder of cholesky.hpp applies.
  Posterior(Inputs inputs, const ConstMatrixView& Y, std::vector<Hyperparameters> hyperparameters);

  Index size() const { return inputs_.size(); }
  Index dimensions() const { return inputs_.dimensions(); }
  Index outputs() const { return static_cast<Index>(hyperparameters_.size()); }

  /// F: rows × D; mean, variance: rows × E, written. The variance is that of the latent function, without noise,
  /// in [0, σ_f²]. A row with a NaN is NaN in both; an infinite or far input gives the prior, 0 and σ_f².
  void predict(const ConstMatrixView& F, MatrixView mean, MatrixView variance) const;

  /// The same means, without the n² work of the variances.
  void predict_mean(const ConstMatrixView& F, MatrixView mean) const;

  const std::vector<Hyperparameters>& hyperparameters() const { return hyperparameters_; }
  const Vector& noise_variances() const { return noise_variances_; }  // E, σ_n²
  const Vector& log_evidences() const { return log_evidences_; }      // E, nats
  const Vector& jitters() const { return jitters_; }                  // E, of the ladder, × σ_f²
  const Inputs& inputs() const { return inputs_; }

  // For moment matching, with c the correlations (the covariance without σ_f²) and K/σ_f² = L Lᵀ:
  auto weights(Index e) const { return weights_.col(e); }  // n, w = σ_f² K⁻¹y: the mean is Σ_i w_i c(x, x_i)
  Matrix inverse_factor(Index e) const;                    // n × n, L⁻¹, lower; a copy

 private:
  void condition(Index e, const ConstVectorView& y, Workspace& workspace);
  const double* points(Index e) const { return points_.col(e * size()).data(); }

  Inputs inputs_;
  std::vector<Hyperparameters> hyperparameters_;
  Matrix factors_;          // D × E, from unit inputs to inputs / ℓ
  Matrix points_;           // D × nE: inputs / ℓ, one a column
  Matrix weights_;          // n × E
  Matrix inverse_factors_;  // packed_size(n) × E: L⁻¹, see prediction_kernel.hpp
  Vector signal_variances_, noise_variances_, log_evidences_, jitters_;
};

}  // namespace rehearse::gp
