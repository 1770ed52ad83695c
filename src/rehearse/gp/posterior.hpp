#pragma once

#include <optional>
#include <vector>

#include "rehearse/gp/hyperparameters.hpp"
#include "rehearse/gp/inputs.hpp"
#include "rehearse/gp/posterior_output.hpp"

namespace rehearse::gp {

struct Summary;
class PredictionChunk;
class Workspace;

/// E independent GPs conditioned on the same inputs (Rasmussen 2006, eqs 2.25 and 2.26), made for batches. Immutable;
/// const methods may run concurrently. A row's result has the same bits on any thread and whatever rows come with it.
/// No allocation after a thread's first call.
class Posterior {
 public:
  /// Y: n × E targets; one set of hyperparameters per output. Throws InvalidInput on wrong sizes or values that are
  /// not finite. The jitter ladder of cholesky.hpp applies.
  ///
  /// `tolerance` > 0 allows errors of the mean and of the standard deviation, as a fraction of σ_n: an output whose
  /// data a few points sum up (compression.hpp) is predicted from these. At every input, s̃ the standard deviation
  /// there, the error of the mean is at most tolerance · σ_n · max(1, s̃/σ_f), where s̃ exceeds σ_f only far from the
  /// data of a trend; that of the standard deviation too if σ_n² ≥ σ_f²/100. Elsewhere the latter is at most tolerance
  /// · s̃, and measured at, between and beyond the training inputs, where it is kept below a fifth of tolerance · σ_n.
  ///
  /// `signs` (D) of images: the functions are odd (odd.hpp); empty: they are not. The evidence is that of odd functions
  /// then.
  Posterior(Inputs inputs, const ConstMatrixView& Y, std::vector<Hyperparameters> hyperparameters, double tolerance = 0,
            Vector signs = {});

  Index size() const { return inputs_.size(); }
  Index dimensions() const { return inputs_.dimensions(); }
  Index outputs() const { return static_cast<Index>(hyperparameters_.size()); }

  /// F: rows × D; mean, variance: rows × E, written. The variance is that of the latent function, without noise,
  /// in [0, σ_f²]. A row with a NaN is NaN in both; an infinite or far input gives the prior, 0 and σ_f². With a trend
  /// both grow without bound there, and an infinite input gives NaN.
  void predict(const ConstMatrixView& F, MatrixView mean, MatrixView variance) const;

  /// The same means and variances, of the same bits, and their derivatives by the inputs: column e·D + d holds that of
  /// output e by input d (rows × E·D). 0 for a variance that rounding has made 0.
  void linearise(const ConstMatrixView& F, MatrixView mean, MatrixView variance, MatrixView mean_by,
                 MatrixView variance_by) const;

  /// The same means, without the work of the variances.
  void predict_mean(const ConstMatrixView& F, MatrixView mean) const;

  const std::vector<Hyperparameters>& hyperparameters() const { return hyperparameters_; }
  const Vector& noise_variances() const { return noise_variances_; }  // E, σ_n²
  const Vector& log_evidences() const { return log_evidences_; }      // E, nats
  const Vector& jitters() const { return jitters_; }  // E, × σ_f², what the ladder of cholesky.hpp added
  const Inputs& inputs() const { return inputs_; }

  /// Points that the mean and the variance of output e are computed from; n where none is left out.
  Index mean_points(Index e) const { return output(e).weights.size(); }
  Index variance_points(Index e) const { return output(e).support; }

  // For moment matching, without tolerance, trend or signs; with c the correlations (the covariance without σ_f²) and
  // K/σ_f² = L Lᵀ:
  const Vector& weights(Index e) const { return output(e).weights; }  // n, w = σ_f² K⁻¹y: the mean is Σ_i w_i c(x, x_i)
  Matrix inverse_factor(Index e) const;                               // n × n, L⁻¹, lower; a copy

 private:
  using Output = PosteriorOutput;

  const Output& output(Index e) const { return outputs_[static_cast<std::size_t>(e)]; }
  // odd_C: n × n covariances over σ_f² of an odd function (odd.hpp); of others not read.
  Output condition(Index e, const ConstVectorView& y, const Matrix& odd_C, Workspace& workspace);
  std::optional<Output> compress(Index e, const ConstVectorView& y, const Output& exact, double tolerance,
                                 const Matrix& odd_C, Workspace& workspace) const;
  static std::optional<Output> condition(const Summary& summary, const Output& exact, Workspace& workspace);
  bool odd() const { return signs_.size() > 0; }
  PosteriorPoints scaled(Index e, const Matrix& unit) const;
  void scale(Index e, PredictionChunk& s) const;
  Matrix trend_map(Index e) const;
  Vector trend_form(Index e, const Output& output) const;
  static void use_all_for_mean(const Output& exact, std::vector<Index> order, Output& few);
  double deviation_error(Index e, const Output& exact, const Output& other) const;
  template <class Chunk, class Visit>
  void for_each_chunk(const ConstMatrixView& F, Visit visit) const;
  template <class Write>
  void predict(const ConstMatrixView& F, bool only_mean, Write write) const;

  Inputs inputs_;
  std::vector<Hyperparameters> hyperparameters_;
  Vector signs_;          // D, or none
  Matrix factors_;        // D × E, from unit inputs to inputs / ℓ
  Matrix trend_factors_;  // 1 + D × E, from inputs to z
  std::vector<Output> outputs_;
  Vector noise_variances_, log_evidences_, jitters_;
};

}  // namespace rehearse::gp
