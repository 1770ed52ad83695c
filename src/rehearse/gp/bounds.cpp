#include "rehearse/gp/bounds.hpp"

#include <algorithm>
#include <cmath>

namespace rehearse::gp {
namespace {

double square(double x) { return x * x; }

/// A start at a bound is moved inside by this fraction (of the variance), where the gradient has not vanished.
constexpr double kInside = 1e-2;

/// 1 / (1/max² + e^{−2u}), which is e^{2u} far below max².
double below_max(double u, double max) { return 1 / (1 / square(max) + std::exp(-2 * u)); }

/// ln of a magnitude between min and max, its derivative by u, and the u of a magnitude, a little inside.
double log_between(double u, Interval range) { return 0.5 * std::log(square(range.low) + below_max(u, range.high)); }
double slope_between(double u, Interval range) {
  const double m = below_max(u, range.high);
  return (1 - m / square(range.high)) * m / (square(range.low) + m);
}
double free_between(double log_magnitude, Interval range) {
  const double low = square(range.low), high = square(range.high);
  const double m = std::max(std::exp(2 * log_magnitude) - low, kInside * low);
  return -0.5 * std::log(std::max(1 / m - 1 / high, kInside / high));
}

/// u of the largest variance: half the logarithm of total − floor, or of a small fraction of the floor.
double log_excess(double total, double floor) { return 0.5 * std::log(std::max(total - floor, kInside * floor)); }

}  // namespace

double usable_scale(double scale) { return scale > 0 && std::isfinite(scale) ? scale : 1; }

SoftBounds::SoftBounds(const Bounds& bounds, const Inputs& inputs, double scale)
    : bounds_(bounds),
      lengths_{bounds.min_length, bounds.max_length},
      trends_{std::sqrt(bounds.min_trend), std::sqrt(bounds.max_trend)},
      log_spread_(inputs.spread().array().log()),
      log_scale_(std::log(usable_scale(scale))),
      log_trend_(log_spread_.size() + 1) {
  log_trend_ << log_scale_ / 2, log_scale_ / 2 - inputs.magnitude().array().log();
}

/// ln τ of free variables.
Vector SoftBounds::trend(const Vector& u) const {
  const Index D = log_spread_.size();
  Vector trend(u.size() - D - 2);
  for (Index k = 0; k < trend.size(); ++k) trend(k) = log_trend_(k) + log_between(u(D + 2 + k), trends_);
  return trend;
}

/// (Σ_d τ_d²)² in units of scale².
double SoftBounds::trend_variance(const ConstVectorView& trend) const {
  return square((2 * (trend - log_trend_.head(trend.size()))).array().exp().sum());
}

Vector SoftBounds::flat(const Vector& u) const {
  const Index D = log_spread_.size();
  Vector flat(u.size());
  for (Index d = 0; d < D; ++d) flat(d) = log_spread_(d) + log_between(u(d), lengths_);
  flat.tail(u.size() - D - 2) = trend(u);
  const double signal = square(bounds_.signal_floor) + std::exp(2 * u(D));
  const double share = (signal + trend_variance(flat.tail(u.size() - D - 2))) / square(bounds_.max_snr);
  const double noise = square(bounds_.noise_floor) + share + std::exp(2 * u(D + 1));
  flat(D) = log_scale_ + 0.5 * std::log(signal);
  flat(D + 1) = log_scale_ + 0.5 * std::log(noise);
  return flat;
}

void SoftBounds::to_free(const Vector& u, Vector& gradient) const {
  const Index D = log_spread_.size();
  for (Index d = 0; d < D; ++d) gradient(d) *= slope_between(u(d), lengths_);
  const double free_signal = std::exp(2 * u(D)), signal = square(bounds_.signal_floor) + free_signal;
  const Vector trend = this->trend(u), terms = (2 * (trend - log_trend_.head(trend.size()))).array().exp();
  const double snr = square(bounds_.max_snr), free_noise = std::exp(2 * u(D + 1));
  const double noise = square(bounds_.noise_floor) + (signal + square(terms.sum())) / snr + free_noise;
  for (Index k = 0; k < trend.size(); ++k) {
    const double by_noise = 2 * terms.sum() * terms(k) / snr / noise;
    gradient(D + 2 + k) = (gradient(D + 2 + k) + gradient(D + 1) * by_noise) * slope_between(u(D + 2 + k), trends_);
  }
  gradient(D) = (gradient(D) + gradient(D + 1) * signal / snr / noise) * free_signal / signal;
  gradient(D + 1) *= free_noise / noise;
}

Vector SoftBounds::free(const Vector& flat) const {
  const Index D = log_spread_.size();
  Vector u(flat.size());
  for (Index d = 0; d < D; ++d) u(d) = free_between(flat(d) - log_spread_(d), lengths_);
  for (Index k = D + 2; k < u.size(); ++k) u(k) = free_between(flat(k) - log_trend_(k - D - 2), trends_);
  const double floor = square(bounds_.signal_floor), noise = std::exp(2 * (flat(D + 1) - log_scale_));
  u(D) = log_excess(std::exp(2 * (flat(D) - log_scale_)), floor);
  const double total = floor + std::exp(2 * u(D)) + trend_variance(trend(u));
  u(D + 1) = log_excess(noise, square(bounds_.noise_floor) + total / square(bounds_.max_snr));
  return u;
}

Vector SoftBounds::clamped(const Vector& flat) const {
  const Index D = log_spread_.size(), trends = flat.size() - D - 2;
  const auto clamp = [](auto values, const ConstVectorView& origin, Interval range) {
    values = values.cwiseMin((origin.array() + std::log(range.high)).matrix())
                 .cwiseMax((origin.array() + std::log(range.low)).matrix());
  };
  Vector inside = flat;
  clamp(inside.head(D), log_spread_, lengths_);
  clamp(inside.tail(trends), log_trend_.head(trends), trends_);
  inside(D) = std::max(inside(D), log_scale_ + std::log(bounds_.signal_floor));
  const double noise_floor = log_scale_ + std::log(bounds_.noise_floor);
  const double total = std::exp(2 * (inside(D) - log_scale_)) + trend_variance(inside.tail(trends));
  inside(D + 1) =
      std::max({inside(D + 1), noise_floor, log_scale_ + 0.5 * std::log(total) - std::log(bounds_.max_snr)});
  return inside;
}

}  // namespace rehearse::gp
