#include "rehearse/moments/sine_moments.hpp"

#include <cmath>

namespace rehearse::moments {
namespace {

/// E[sin] and E[cos] of a sine's argument, times the amplitude.
struct Mean {
  Mean(const Sine& sine, const Gaussian& x) {
    const double argument = sine.frequency * x.mean(sine.input) + sine.phase;
    const double variance = sine.frequency * sine.frequency * x.covariance(sine.input, sine.input);
    const double shrunk = sine.amplitude * std::exp(-variance / 2);
    sin = shrunk * std::sin(argument);
    cos = shrunk * std::cos(argument);
  }
  double sin, cos;
};

/// e^(c − v) − e^(−v), also for small c and where e^c overflows.
double excess(double c, double v) {
  return std::abs(c) < 1 ? std::exp(-v) * std::expm1(c) : std::exp(c - v) - std::exp(-v);
}

/// cov[sin p, sin q] = ½ e^(−v) ((e^c − 1) cos(p − q) − (e^(−c) − 1) cos(p + q)), with p and q the mean arguments, v
/// half the sum of their variances and c their covariance; times both amplitudes.
struct Pair {
  Pair(const Sine& a, const Sine& b, const Gaussian& x) {
    const double p = a.frequency * x.mean(a.input) + a.phase, q = b.frequency * x.mean(b.input) + b.phase;
    const double v = (a.frequency * a.frequency * x.covariance(a.input, a.input) +
                      b.frequency * b.frequency * x.covariance(b.input, b.input)) /
                     2;
    const double c = a.frequency * b.frequency * x.covariance(a.input, b.input), half = a.amplitude * b.amplitude / 2;
    const double apart = half * excess(c, v), together = half * excess(-c, v);
    covariance = apart * std::cos(p - q) - together * std::cos(p + q);
    by_p = -apart * std::sin(p - q) + together * std::sin(p + q);
    by_q = apart * std::sin(p - q) + together * std::sin(p + q);
    by_c = half * (std::exp(c - v) * std::cos(p - q) + std::exp(-c - v) * std::cos(p + q));
  }
  double covariance;        // its derivative by v is minus itself
  double by_p, by_q, by_c;  // derivatives
};

}  // namespace

Transformed sine_moments(const std::vector<Sine>& sines, Index outputs, const Gaussian& x) {
  Transformed result = Transformed::zero(x.size(), outputs);
  for (const Sine& a : sines) {
    const Mean mean(a, x);
    result.mean(a.output) += mean.sin;
    result.gain(a.input, a.output) += a.frequency * mean.cos;  // E[f′] (Stein 1981)
    for (const Sine& b : sines) result.covariance(a.output, b.output) += Pair(a, b, x).covariance;
  }
  return result;
}

void sine_adjoint(const std::vector<Sine>& sines, const Gaussian& x, const Transformed& adjoint, Gaussian& x_adjoint) {
  for (const Sine& a : sines) {
    const Mean mean(a, x);
    const double by_mean = adjoint.mean(a.output), by_gain = adjoint.gain(a.input, a.output), w = a.frequency;
    x_adjoint.mean(a.input) += by_mean * w * mean.cos - by_gain * w * w * mean.sin;
    x_adjoint.covariance(a.input, a.input) -= (by_mean * mean.sin + by_gain * w * mean.cos) * w * w / 2;
    for (const Sine& b : sines) {
      const Pair pair(a, b, x);
      const double by = adjoint.covariance(a.output, b.output);
      x_adjoint.mean(a.input) += by * w * pair.by_p;
      x_adjoint.mean(b.input) += by * b.frequency * pair.by_q;
      x_adjoint.covariance(a.input, a.input) -= by * pair.covariance * w * w / 2;
      x_adjoint.covariance(b.input, b.input) -= by * pair.covariance * b.frequency * b.frequency / 2;
      x_adjoint.covariance(a.input, b.input) += by * pair.by_c * w * b.frequency;
    }
  }
}

}  // namespace rehearse::moments
