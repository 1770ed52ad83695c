#pragma once

#include <optional>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/dynamics/residuals.hpp"
#include "rehearse/gp/fit.hpp"
#include "rehearse/identification/score.hpp"

namespace rehearse::identification {

/// A φ and the kernels fitted to the residuals there.
struct Fit {
  Vector phi;
  std::vector<gp::FitStart> kernels;  // one an output; no length scales: not fitted yet
  Vector log_evidences;               // one an output, nats; NaN where the kernel could not be fitted
  Index left_out = 0;                 // rows whose prior mean is not finite
  double score = -kInf;
  Index evaluations = 0;  // values of φ scored on the way here
};

/// The data and options that φ and kernels are fitted to. References must outlive it.
struct FitProblem {
  const dynamics::Residuals& residuals;
  const prior::Prior* prior;  // null: zero mean
  Score score;
  gp::FitOptions options;  // of the kernels' fits
  const Evaluator& evaluator;

  /// Fits the kernels at the fit's φ, in parallel, from what they are, and scores it: −∞ if no row is left.
  void refit(Fit& fit) const { refit(fit, options); }
  void refit(Fit& fit, const gp::FitOptions& options) const;

  /// The score of these log evidences, with `left_out` rows failing. A φ at which rows fail must not win by having
  /// fewer of them to explain: a row that fails counts as if it were predicted with the spread of the changes.
  double charged_score(const Vector& log_evidences, Index left_out) const;
};

/// A fit at φ that is still to be made, from the `kernels` of an earlier fit, or from none.
Fit unfitted(const Vector& phi, Index outputs, const std::vector<gp::Hyperparameters>& kernels);

std::vector<gp::Hyperparameters> hyperparameters(const Fit& fit);

/// The start of learning: the state that `learn` returned the time before.
struct WarmStart {
  std::vector<gp::Hyperparameters> kernels;  // one an output; empty: from the data
  std::optional<Vector> phi;                 // of the prior; empty: its own values
  bool odd = false;                          // the robot was taken for its own mirror image
};

}  // namespace rehearse::identification
