#pragma once

#include <limits>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/dynamics/residuals.hpp"
#include "rehearse/dynamics/score.hpp"
#include "rehearse/gp/fit.hpp"

namespace rehearse::dynamics {

/// Of GPs, to have a length for each input and a trend in any case: a few trials tell too little of more.
inline constexpr Index kFewInputs = 16;

/// For GPs of so many inputs: parsimonious where they are more than a few.
gp::FitOptions fit_options(const gp::FitOptions& options, Index inputs);

/// A φ and the kernels fitted to the residuals there.
struct Estimate {
  Vector phi;
  std::vector<gp::FitStart> kernels;  // one an output; no length scales: not fitted yet
  Vector log_evidences;               // one an output, nats; NaN where the kernel could not be fitted
  Index left_out = 0;                 // rows whose prior mean is not finite
  double score = -std::numeric_limits<double>::infinity();
  Index evaluations = 0;  // values of φ scored on the way here
};

/// What an estimate is of. References must outlive it.
struct Estimation {
  const Residuals& residuals;
  const prior::Prior* prior;  // null: zero mean
  Score score;
  gp::FitOptions fit;
  const Evaluator& evaluator;

  /// Fits the kernels at the estimate's φ, in parallel, from what they are, and scores it: −∞ if no row is left.
  void refit(Estimate& estimate) const { refit(estimate, fit); }
  void refit(Estimate& estimate, const gp::FitOptions& options) const;

  /// The score of these log evidences, with `left_out` rows failing. A φ at which rows fail must not win by having
  /// fewer of them to explain: a row that fails counts as if the model knew no more of it than the spread of the
  /// changes.
  double charged_score(const Vector& log_evidences, Index left_out) const;
};

/// At φ, not fitted yet; `kernels` of an earlier fit, or none.
Estimate unfitted(const Vector& phi, Index outputs, const std::vector<gp::Hyperparameters>& kernels);

std::vector<gp::Hyperparameters> hyperparameters(const Estimate& estimate);

}  // namespace rehearse::dynamics
