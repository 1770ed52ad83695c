#pragma once

#include <vector>

#include "rehearse/gp/evidence.hpp"
#include "rehearse/identification/coordinates.hpp"
#include "rehearse/identification/fit_problem.hpp"
#include "rehearse/identification/score_step.hpp"

namespace rehearse::identification {

/// The score as a function of the continuous parameters alone, the kernels of a fit held: a nonlinear
/// least-squares problem in the whitened residuals, each φ of which costs a triangular solve an output. Coordinates z
/// are in [0, 1], fractions of the boxes.
class HeldKernels {
 public:
  /// The fit must have been fitted with a finite score. The problem must outlive this.
  HeldKernels(const FitProblem& problem, const Fit& fit);

  struct At {
    Matrix targets, whitened;  // rows × outputs
    Vector log_evidences;      // outputs
    double score;              // −∞ if a row fails that did not at the fit's φ
  };
  At at(const Vector& z) const;

  /// Around z, by differences of the prior; a parameter that cannot be moved without failure, or moves nothing, has
  /// slope 0.
  Quadratics quadratics(const Vector& z, const At& at) const;

  Vector start() const { return coordinates_.start(); }  // z of the fit's φ
  Vector phi(const Vector& z) const { return coordinates_.phi(z); }
  const FitProblem& problem() const { return problem_; }
  double score(const Vector& log_evidences) const { return problem_.charged_score(log_evidences, left_out_); }

 private:
  Matrix targets(const Vector& z) const;

  const FitProblem& problem_;
  Coordinates coordinates_;
  std::vector<Index> kept_;  // rows; empty: all
  Index left_out_;           // the others
  std::vector<gp::Whitening> whitenings_;
};

/// The score at the fit's φ with its kernels as they are; −∞ if it has none, or they were never fitted.
double held_score(const FitProblem& problem, const Fit& fit);

/// Moves φ to where the score is highest nearby with the kernels held, by Gauss–Newton steps with Levenberg's damping,
/// and by Subplex where the prior is not smooth enough for differences. The score becomes that with the kernels held.
void climb(const FitProblem& problem, Fit& fit);

}  // namespace rehearse::identification
