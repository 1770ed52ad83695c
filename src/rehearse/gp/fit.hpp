#pragma once

#include <functional>
#include <string>

#include "rehearse/gp/bounds.hpp"
#include "rehearse/gp/evidence.hpp"
#include "rehearse/gp/hyperparameters.hpp"
#include "rehearse/optim/gradient.hpp"

namespace rehearse::gp {

enum class FitMethod { rprop, bfgs };

struct FitOptions {
  FitMethod method = FitMethod::bfgs;  // rprop: Chatzilygeroudis 2018; BFGS needs about a fifth of the evaluations
  optim::RpropOptions rprop;
  optim::BfgsOptions bfgs{.relative_tolerance = 1e-7};  // of a thousand nats: less than a hundredth nat is left
  bool trend = false;      // a quadratic one (hyperparameters.hpp); not a field, since not all who fit can use it
  bool isotropic = false;  // one length for all inputs in units of their spreads; without a trend. No field
  bool parsimonious =
      false;              // for many inputs: the likeliest of a length for each, one for all, and noise alone, where
                          // each hyperparameter costs half a ln n nats (Schwarz 1978); without a trend. No field
  Index starts = 3;       // the better of the given start and the default one; a noisier one; the likeliest of some 40
                          // points all over, which differ in what inputs matter (the authors: 1): the evidence of
                          // small residuals has several optima
  Index part_rows = 200;  // with at least twice as many rows, all starts are tried on a part of about so many, and the
                          // best is continued on all rows; 0: never (the authors)
  Penalties penalties;
  Bounds bounds;
  std::function<void()> before_each;  // evaluation of the evidence; may throw, to stop. Empty: nothing. No field
  void fields(FieldVisitor& v) {
    v.choice("method", method, "how the log evidence is maximised", {"rprop", "bfgs"}, published("rprop"));
    v.group("rprop", rprop);
    v.group("bfgs", bfgs);
    v.integer("starts", starts,
              "starting points of a fit: the given one, a noisier one, then points spread over the space",
              between(1, 1000), published(1, kAuthors));
    v.integer("part_rows", part_rows,
              "rows of the subset on which all starts are tried, if there are at least twice as many; 0: all rows",
              between(0, 1e6), published(0, kAuthors));
    v.group("penalties", penalties);
    v.group("bounds", bounds);
  }
};

/// The start of a fit.
struct FitStart {
  Hyperparameters hyperparameters;
  Matrix inverse_hessian;  // of minus the evidence, in the free coordinates of SoftBounds: of an earlier fit of nearly
                           // the same data, where it falls as 1/n with the rows; may be empty
};

struct Fit {
  enum class Status {
    improved,   // over the start
    unchanged,  // no point better than the start was found: it is returned
    failed,     // the evidence could not be computed anywhere: the start is returned as it was, log_evidence is NaN
  };
  Hyperparameters hyperparameters;
  double log_evidence = 0;  // nats, without penalties
  double penalty = 0;       // ≤ 0
  double jitter = 0;        // of the ladder, at the solution
  Status status = Status::failed;
  std::string stop;        // why the maximiser stopped
  Index evaluations = 0;   // of the evidence of all rows, by the fit that was kept
  Matrix inverse_hessian;  // for FitStart; empty after Rprop
};

/// ℓ = spread(x), σ_f = std(y), σ_n = σ_f/10 (PILCO), inside the bounds; σ_f at least a tenth of the
/// root mean square of y, for targets that are little more than an offset. A trend has τ_0² = σ_f and τ_d² a tenth of
/// it for inputs of their magnitude.
Hyperparameters default_start(const Inputs& inputs, const ConstVectorView& y, double scale, const Bounds& bounds = {},
                              bool trend = false);

/// Maximises the (penalised) log evidence of targets y (n) from `start`, which a warm start takes from an earlier fit,
/// or from the default start where that is better: data may have changed so much that a warm start is hopeless; then
/// from other starts. Never returns worse than the start moved inside the bounds, unless `parsimonious`, where simpler
/// kernels may win. `scale` > 0: see Bounds. Throws InvalidInput only if sizes do not agree. Any thread; the workspace
/// is the thread's own. Unless null, `noise` is that of the targets beside σ_n; parts of the rows are not tried then.
Fit fit(const Inputs& inputs, const ConstVectorView& y, double scale, const FitStart& start,
        const FitOptions& options = {}, const KnownNoise* noise = nullptr);
inline Fit fit(const Inputs& inputs, const ConstVectorView& y, double scale, const Hyperparameters& start,
               const FitOptions& options = {}, const KnownNoise* noise = nullptr) {
  return fit(inputs, y, scale, FitStart{start, {}}, options, noise);
}

/// The same from the default start, in the scale of the targets.
Fit fit(const Inputs& inputs, const ConstVectorView& y, const FitOptions& options);

}  // namespace rehearse::gp
