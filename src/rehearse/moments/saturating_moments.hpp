#pragma once

#include "rehearse/moments/gaussian.hpp"
#include "rehearse/reward/saturating.hpp"

namespace rehearse::moments {

/// Moments of the reward exp(−½ ‖distances (f − goal)‖²) of Gaussian features f.
struct RewardMoments {
  double mean = 0;      // in [0, 1]
  double variance = 0;  // ≥ 0
  Gaussian by_mean;     // the derivatives of the mean by those of f; the first is also s⁻¹ cov[f, reward]
};

/// Deisenroth 2010, section 3.7 (PILCO's lossSat is 1 − reward). Not finite where the covariance is far from
/// positive semi-definite.
RewardMoments saturating_moments(const reward::ClosedForm& reward, const Gaussian& features);

}  // namespace rehearse::moments
