#pragma once

#include <vector>

#include "rehearse/gp/hyperparameters.hpp"
#include "rehearse/gp/inputs.hpp"

namespace rehearse::gp {

/// E independent GPs conditioned on the same inputs (Rasmussen 2006, eqs 2.25 and 2.26), made for batches. Immutable;
/// const methods may run concurrently and give the same bits on any thread: rows are predicted in chunks of a fixed
/// size, so a row's result does not depend on how many come with it. No allocation after a thread's first call.
class Posterior {
 public:
  /// Rows of K* in one triangular product; the last chunk is padded.
  static constexpr Index kChunk = 64;

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
  auto weights(Index e) const {
    return weights_.col(e).head(size());
  }                                     // n, w = σ_f² K⁻¹y: the mean is Σ_i w_i c(x, x_i)
  auto inverse_factor(Index e) const {  // n × n, L⁻¹
    return inverse_factors_[static_cast<std::size_t>(e)].topLeftCorner(size(), size());
  }

 private:
  void condition(Index e, const ConstVectorView& y);

  Inputs inputs_;
  std::vector<Hyperparameters> hyperparameters_;
  std::vector<Vector> factors_;          // E of D: from unit inputs to inputs / ℓ
  std::vector<Matrix> scaled_;           // E of padded n × D: inputs / ℓ
  std::vector<Matrix> inverse_factors_;  // E of padded n × padded n, zero above and in the padding
  Matrix weights_;                       // padded n × E
  Vector signal_variances_, noise_variances_, log_evidences_, jitters_;
};

}  // namespace rehearse::gp
