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

/// u of the largest variance: half the logarithm of total − floor, or of a small fraction of the floor.
double log_excess(double total, double floor) { return 0.5 * std::log(std::max(total - floor, kInside * floor)); }

}  // namespace

SoftBounds::SoftBounds(const Bounds& bounds, const Inputs& inputs, double scale)
    : bounds_(bounds),
      log_spread_(inputs.spread().array().log()),
      log_scale_(scale > 0 && std::isfinite(scale) ? std::log(scale) : 0) {}

Vector SoftBounds::flat(const Vector& u) const {
  const Index D = log_spread_.size();
  Vector flat(D + 2);
  for (Index d = 0; d < D; ++d)
    flat(d) = log_spread_(d) + 0.5 * std::log(square(bounds_.min_length) + below_max(u(d), bounds_.max_length));
  const double signal = square(bounds_.signal_floor) + std::exp(2 * u(D));
  const double noise = square(bounds_.noise_floor) + signal / square(bounds_.max_snr) + std::exp(2 * u(D + 1));
  flat(D) = log_scale_ + 0.5 * std::log(signal);
  flat(D + 1) = log_scale_ + 0.5 * std::log(noise);
  return flat;
}

void SoftBounds::to_free(const Vector& u, Vector& gradient) const {
  const Index D = log_spread_.size();
  for (Index d = 0; d < D; ++d) {
    const double m = below_max(u(d), bounds_.max_length);
    gradient(d) *= (1 - m / square(bounds_.max_length)) * m / (square(bounds_.min_length) + m);
  }
  const double free_signal = std::exp(2 * u(D)), signal = square(bounds_.signal_floor) + free_signal;
  const double share = signal / square(bounds_.max_snr), free_noise = std::exp(2 * u(D + 1));
  const double noise = square(bounds_.noise_floor) + share + free_noise;
  gradient(D) = (gradient(D) + gradient(D + 1) * share / noise) * free_signal / signal;
  gradient(D + 1) *= free_noise / noise;
}

Vector SoftBounds::free(const Vector& flat) const {
  const Index D = log_spread_.size();
  Vector u(D + 2);
  for (Index d = 0; d < D; ++d) {
    const double low = square(bounds_.min_length), high = square(bounds_.max_length);
    const double m = std::max(std::exp(2 * (flat(d) - log_spread_(d))) - low, kInside * low);
    u(d) = -0.5 * std::log(std::max(1 / m - 1 / high, kInside / high));
  }
  const double floor = square(bounds_.signal_floor), noise = std::exp(2 * (flat(D + 1) - log_scale_));
  u(D) = log_excess(std::exp(2 * (flat(D) - log_scale_)), floor);
  const double signal = floor + std::exp(2 * u(D));
  u(D + 1) = log_excess(noise, square(bounds_.noise_floor) + signal / square(bounds_.max_snr));
  return u;
}

Vector SoftBounds::clamped(const Vector& flat) const {
  const Index D = log_spread_.size();
  Vector inside = flat;
  inside.head(D) = inside.head(D)
                       .cwiseMin((log_spread_.array() + std::log(bounds_.max_length)).matrix())
                       .cwiseMax((log_spread_.array() + std::log(bounds_.min_length)).matrix());
  inside(D) = std::max(inside(D), log_scale_ + std::log(bounds_.signal_floor));
  const double noise_floor = log_scale_ + std::log(bounds_.noise_floor);
  inside(D + 1) = std::max({inside(D + 1), noise_floor, inside(D) - std::log(bounds_.max_snr)});
  return inside;
}

}  // namespace rehearse::gp
