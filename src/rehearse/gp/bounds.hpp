#pragma once

#include "rehearse/core/options.hpp"
#include "rehearse/gp/hyperparameters.hpp"
#include "rehearse/gp/inputs.hpp"

namespace rehearse::gp {

/// The bounds of hyperparameters. The floors are relative to `scale`, the standard deviation of the raw targets before
/// the prior mean was subtracted: a perfect prior leaves residuals of zero, whose evidence would otherwise grow without
/// end.
struct Bounds {
  double signal_floor = 1e-6;  // σ_f ≥ this × scale
  double noise_floor = 1e-6;   // σ_n ≥ this × scale
  double max_snr = 1e5;  // σ_f / σ_n ≤ this: at 10⁶ the variances of predictions are rounding (docs/performance.md)
  double min_length = 1e-3;  // ℓ_d ≥ this × spread of x_d
  double max_length = 1e4;   // ℓ_d ≤ this × spread of x_d; without it those of irrelevant inputs reach e^400
  double min_trend = 1e-10;  // τ_0², and τ_d² × magnitude of x_d squared, ≥ this × scale
  double max_trend = 1e3;    // and ≤ this × scale
  void fields(FieldVisitor& v) {
    v.number("signal_floor", signal_floor, "smallest σ_f, as a fraction of the targets' standard deviation", above(0));
    v.number("noise_floor", noise_floor, "smallest σ_n, as a fraction of the targets' standard deviation", above(0));
    v.number("max_snr", max_snr, "σ_f / σ_n at most", above(1));
    v.number("min_length", min_length, "smallest length scale, in standard deviations of the input", above(0));
    v.number("max_length", max_length, "largest length scale, in standard deviations of the input", above(0));
    v.number("min_trend", min_trend, "smallest scale of the trend, in standard deviations of the targets", above(0));
    v.number("max_trend", max_trend, "largest scale of the trend, in standard deviations of the targets", above(0));
    v.require(min_length < max_length,
              "min_length = " + to_text(min_length) + ", must be < max_length = " + to_text(max_length));
    v.require(min_trend < max_trend,
              "min_trend = " + to_text(min_trend) + ", must be < max_trend = " + to_text(max_trend));
  }
};

/// A scale of 0, or not finite, counts as 1.
double usable_scale(double scale);

/// The bounds as a smooth map from free variables u (as many as hyperparameters) to flat log hyperparameters that
/// cannot leave them:
///
///   ℓ_d² = min² + 1 / (1/max² + e^{−2u_d}),   τ_d² likewise,
///   σ_f² = floor² + e^{2u_D},   σ_n² = floor² + (σ_f² + (Σ_d τ_d²)²)/max_snr² + e^{2u_{D+1}}
///
/// Far from a bound it is the identity (ℓ in spreads, 1/τ_d in magnitudes, σ and τ² in scales), and at a bound the
/// gradient vanishes: a maximiser without bounds stops there by itself. The noise reads as a sum of variances: floor,
/// share of the signal, learned.
class SoftBounds {
 public:
  SoftBounds(const Bounds& bounds, const Inputs& inputs, double scale);

  Vector flat(const Vector& u) const;

  /// A gradient with respect to the flat log hyperparameters becomes one with respect to u.
  void to_free(const Vector& u, Vector& gradient) const;

  /// The u of the flat log hyperparameters nearest to `flat`, a little inside the bounds so that they can be left.
  Vector free(const Vector& flat) const;

  /// `flat` moved to the bounds where it is outside.
  Vector clamped(const Vector& flat) const;

 private:
  Vector trend(const Vector& u) const;
  double trend_variance(const ConstVectorView& trend) const;

  Bounds bounds_;
  Interval lengths_, trends_;
  Vector log_spread_;  // D
  double log_scale_;
  Vector log_trend_;  // 1 + D, ln τ of which an input of its magnitude makes a scale of the target
};

}  // namespace rehearse::gp
