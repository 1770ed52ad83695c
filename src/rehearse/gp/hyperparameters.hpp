#pragma once
// The covariance of every GP here: squared exponential with one length scale per input, plus noise,
//
//   k(x, y) = σ_f² exp(−½ Σ_d (x_d − y_d)² / ℓ_d²) + σ_n² δ_xy            (Rasmussen 2006, eq. 5.1)

#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::gp {

/// Standard deviations, not variances; natural logarithms.
struct Hyperparameters {
  Vector log_lengths;     // D, ln ℓ_d in the units of the inputs
  double log_signal = 0;  // ln σ_f in the units of the target
  double log_noise = 0;   // ln σ_n in the units of the target

  Index inputs() const { return log_lengths.size(); }
  Vector lengths() const { return log_lengths.array().exp(); }
  double signal_variance() const;
  double noise_variance() const;

  /// [ln ℓ_1 … ln ℓ_D, ln σ_f, ln σ_n], D + 2 numbers: the order of every gradient and of PILCO's files.
  Vector flat() const;
  static Hyperparameters from_flat(const ConstVectorView& flat);
};

/// A line for every number that is missing or not finite; `name` begins each line.
std::vector<std::string> violations(const Hyperparameters& hyperparameters, Index inputs, const std::string& name);

}  // namespace rehearse::gp
