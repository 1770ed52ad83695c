#pragma once

#include <string>

#include "rehearse/gp/bounds.hpp"
#include "rehearse/gp/evidence.hpp"
#include "rehearse/gp/hyperparameters.hpp"
#include "rehearse/optim/gradient.hpp"

namespace rehearse::gp {

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
    failed,     // the evidence could not be computed anywhere: the start is returned as it was, log_evidence is NaN
  };
  Hyperparameters hyperparameters;
  double log_evidence = 0;  // nats, without penalties
  double penalty = 0;       // ≤ 0
  double jitter = 0;        // of the ladder, at the solution
  Status status = Status::failed;
  std::string stop;  // why the maximiser stopped
  Index evaluations = 0;
};

/// ℓ = spread(x), σ_f = std(y), σ_n = σ_f/10 (PILCO), inside the bounds; σ_f at least a tenth of the
/// root mean square of y, for targets that are little more than an offset.
Hyperparameters default_start(const Inputs& inputs, const ConstVectorView& y, double scale, const Bounds& bounds = {});

/// Maximises the (penalised) log evidence of targets y (n) from `start`, which a warm start takes from an earlier fit,
/// or from the default start where that is better: data may have changed so much that a warm start is hopeless. Never
/// returns worse than the start moved inside the bounds. `scale` > 0: see Bounds. Throws InvalidInput only if sizes do
/// not agree. Any thread; the workspace is the thread's own.
Fit fit(const Inputs& inputs, const ConstVectorView& y, double scale, const Hyperparameters& start,
        const FitOptions& options = {});

}  // namespace rehearse::gp
