#pragma once

#include <string>

#include "rehearse/gp/evidence.hpp"
#include "rehearse/gp/hyperparameters.hpp"
#include "rehearse/optim/gradient.hpp"

namespace rehearse::gp {

/// Soft bounds: what the maximisers move is free, and the hyperparameters approach a bound without reaching past it.
/// The floors are relative to `scale`, the standard deviation of the raw targets before the prior mean was
/// subtracted: a perfect prior leaves residuals of zero, whose evidence would otherwise grow without end.
struct Bounds {
  double signal_floor = 1e-6;  // σ_f ≥ this × scale
  double noise_floor = 1e-6;   // σ_n ≥ this × scale
  double max_snr = 1e5;        // σ_f / σ_n ≤ this: beyond it double precision has no gradient
  double min_length = 1e-3;    // ℓ_d ≥ this × std(x_d)
  double max_length = 1e4;     // ℓ_d ≤ this × std(x_d); without it those of irrelevant inputs reach e^400
  void fields(FieldVisitor& v) {
    v.number("signal_floor", signal_floor, above(0));
    v.number("noise_floor", noise_floor, above(0));
    v.number("max_snr", max_snr, above(1));
    v.number("min_length", min_length, above(0));
    v.number("max_length", max_length, above(0));
  }
};

enum class FitMethod { rprop, lbfgs };

struct FitOptions {
  FitMethod method = FitMethod::rprop;  // Chatzilygeroudis 2018; L-BFGS needs about a tenth of the evaluations
  optim::RpropOptions rprop;
  optim::LbfgsOptions lbfgs;
  Penalties penalties;
  Bounds bounds;
  void fields(FieldVisitor& v) {
    v.choice("method", method, {"rprop", "lbfgs"});
    v.group("rprop", rprop);
    v.group("lbfgs", lbfgs);
    v.group("penalties", penalties);
    v.group("bounds", bounds);
  }
};

struct Fit {
  enum class Status {
    improved,   // over the start
    unchanged,  // no point better than the start was found: it is returned
    failed,     // the evidence could not be computed anywhere: the start is returned, log_evidence is NaN
  };
  Hyperparameters hyperparameters;
  double log_evidence = 0;  // nats, without penalties
  double penalty = 0;       // ≤ 0
  double jitter = 0;        // of the ladder, at the solution
  Status status = Status::failed;
  std::string stop;  // why the maximiser stopped
  Index evaluations = 0;
};

/// ℓ = std(x), σ_f = std(y), σ_n = std(y)/10 (PILCO), inside the bounds.
Hyperparameters default_start(const Inputs& inputs, const ConstVectorView& y, double scale, const Bounds& bounds = {});

/// Maximises the (penalised) log evidence of targets y (n) from `start`, which a warm start takes from an earlier fit.
/// Never returns worse than the start moved inside the bounds; never throws on what numbers do. `scale` > 0: see
/// Bounds; 0 or NaN counts as 1. Any thread; keeps one workspace per thread.
Fit fit(const Inputs& inputs, const ConstVectorView& y, double scale, const Hyperparameters& start,
        const FitOptions& options = {});

}  // namespace rehearse::gp
