#pragma once

#include <utility>
#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/gp/hyperparameters.hpp"
#include "rehearse/gp/inputs.hpp"

namespace rehearse::gp {

inline constexpr double kLogTwoPi = 1.8378770664093454836;

/// Keep hyperparameters in range: smooth walls added to the log evidence (PILCO; the code of Chatzilygeroudis 2018),
/// and a log-normal prior of the lengths (Hvarfner 2024), without which white noise may be taken for a function of
/// short ones.
struct Penalties {
  bool length = false;          // −Σ_d ((ln ℓ_d − ln std(x_d)) / ln length_limit)^30
  double length_limit = 100;    // PILCO and the authors
  bool snr = false;             // −((ln σ_f − ln σ_n) / ln snr_limit)^30
  double snr_limit = 500;       // the authors; PILCO 1000
  double length_deviation = 0;  // s > 0: −½ Σ_d ((ln ℓ_d − ln(length_median std(x_d))) / s)²
  double length_median = 10;
  void fields(FieldVisitor& v) {
    v.boolean("length", length, "penalty on length scales far from the inputs' standard deviations (PILCO)");
    v.number("length_limit", length_limit,
             "largest length scale, and 1 / smallest, in standard deviations of the input",
             {.low = 1, .low_open = true});
    v.boolean("snr", snr, "penalty on signal-to-noise ratios σ_f / σ_n above snr_limit (PILCO)");
    v.number("snr_limit", snr_limit, "σ_f / σ_n at most (PILCO: 1000)", {.low = 1, .low_open = true});
    v.number("length_deviation", length_deviation,
             "standard deviation of the length scales' log-normal prior [nats]; 0: no prior", at_least(0),
             published(0));
    v.number("length_median", length_median,
             "median of the length scales' log-normal prior, in standard deviations of the input", above(0));
  }
};

/// Buffers that evaluations reuse: none allocates after the first of the same size. Not shared between threads.
class Workspace {
 public:
  void resize(Index n, Index dimensions, bool trend);

  double* tiles() { return tiles_.data(); }           // n × n, lower, see tiles.hpp
  double* scaled() { return scaled_.data(); }         // inputs / ℓ, see kernel.hpp
  double* weights() { return weights_.data(); }       // padded(n)
  double* sums() { return sums_.data(); }             // 8 (D + 1)
  Vector& factors() { return factors_; }              // D
  Vector& trend_factors() { return trend_factors_; }  // 1 + D, τ/√σ_f; empty without a trend
  double* trend() { return trend_factors_.size() == 0 ? nullptr : trend_.data(); }  // z, see kernel.hpp
  std::vector<double> release_tiles() && { return std::move(tiles_); }

 private:
  std::vector<double> tiles_, scaled_, weights_, sums_, trend_;
  Vector factors_, trend_factors_;
};

struct Evidence {
  double value = 0;   // log p(y | X, θ) in nats; NaN if it could not be computed
  double jitter = 0;  // × σ_f², what the ladder of cholesky.hpp added to the diagonal
  bool ok() const;    // the value is finite
};

/// A covariance of errors of the targets (n × n, its lower triangle), added to that of the kernel. Immutable.
class KnownNoise {
 public:
  explicit KnownNoise(const Matrix& covariance);
  Index size() const { return size_; }
  const double* tiles() const { return tiles_.data(); }  // tiles.hpp

 private:
  Index size_;
  std::vector<double> tiles_;
};

/// Writes the inputs over their lengths, and those of the trend, into the workspace, which is resized for them. False
/// if a factor is not finite.
bool scale_inputs(const Inputs& inputs, const ConstVectorView& flat, Workspace& workspace);

/// The log evidence of targets y (n) at flat log hyperparameters (D + 2, or 2 D + 3; Rasmussen 2006, eq. 5.8) and,
/// unless null, its gradient with respect to them (eq. 5.9); with `noise` unless null. Throws
/// InvalidInput on wrong sizes, on no value of `flat` or `y`: what cannot be computed has value and gradient NaN.
Evidence evidence(const Inputs& inputs, const ConstVectorView& y, const ConstVectorView& flat, Workspace& workspace,
                  Vector* gradient = nullptr, const KnownNoise* noise = nullptr);

/// The same of a covariance over σ_f² that is given, without noise (n × n, of which the lower triangle counts), in a
/// workspace that has been resized for it. Its tiles become the factor, as those of the other do without a gradient;
/// what else it holds stays.
Evidence evidence(const Matrix& covariance, const ConstVectorView& y, const Hyperparameters& kernel,
                  Workspace& workspace);

/// An output's kernel held while its targets change. With K = L Lᵀ, whitened targets are w = L⁻¹ y, and the log
/// evidence of y is a constant less ‖w‖²/2. Immutable; any thread.
class Whitening {
 public:
  Whitening(const Inputs& inputs, const Hyperparameters& kernel);

  Matrix operator()(const ConstMatrixView& Y) const;           // n × any, as Y
  double log_evidence(const ConstVectorView& whitened) const;  // n; NaN if K could not be factorised

 private:
  Index size_;
  std::vector<double> tiles_;
  double inverse_signal_, log_constant_;
};

/// The value of the penalties, ≤ 0; adds their gradient unless null.
double penalty(const Inputs& inputs, const ConstVectorView& flat, const Penalties& penalties,
               Vector* gradient = nullptr);

}  // namespace rehearse::gp
