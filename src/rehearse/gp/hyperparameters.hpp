#pragma once
// The covariance k of every GP here, from which that of odd functions (odd.hpp) is made: squared exponential with one
// length scale per input, plus noise, and if asked for a quadratic trend, which goes on where there are no data
// (Rasmussen 2006, eqs 5.1 and 4.17; Amadio 2022):
//
//   k(x, y) = σ_f² exp(−½ Σ_d (x_d − y_d)² / ℓ_d²) + (τ_0² + Σ_d τ_d² x_d y_d)² + σ_n² δ_xy

#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::gp {

/// Standard deviations, not variances; natural logarithms.
struct Hyperparameters {
  Vector log_lengths;     // D, ln ℓ_d in the units of the inputs
  double log_signal = 0;  // ln σ_f in the units of the target
  double log_noise = 0;   // ln σ_n in the units of the target
  Vector log_trend = {};  // 1 + D, ln τ_0 and ln τ_d; empty: no trend

  Index inputs() const { return log_lengths.size(); }
  Vector lengths() const { return log_lengths.array().exp(); }
  double signal_variance() const;
  double noise_variance() const;

  bool has_trend() const { return log_trend.size() > 0; }

  /// [ln ℓ_1 … ln ℓ_D, ln σ_f, ln σ_n], D + 2 numbers: the order of every gradient and of PILCO's files; with a trend
  /// then [ln τ_0 … ln τ_D], 2 D + 3 numbers in all.
  Vector flat() const;
  /// Throws InvalidInput if there are so many neither with nor without a trend.
  static Hyperparameters from_flat(const ConstVectorView& flat, Index inputs);
};

/// A line for every number that is missing or not finite; `name` begins each line.
std::vector<std::string> violations(const Hyperparameters& hyperparameters, Index inputs, const std::string& name);

}  // namespace rehearse::gp
