#pragma once
// The posterior of φ given the data.

#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/parameters.hpp"
#include "rehearse/identification/fit_problem.hpp"
#include "rehearse/identification/smoothing/errors_in_variables.hpp"

namespace rehearse::identification {

/// Standard deviations of a normal distribution that hold 95 % on both sides.
inline constexpr double kNormal = 1.959963984540054;

/// The knowledge of the prior's continuous parameters: a normal distribution around the φ learned.
struct PhiPosterior {
  std::vector<Parameter> parameters;  // q: the continuous ones, with their boxes
  Vector mean;                        // q, the φ learned
  Matrix covariance;                  // q × q, positive definite

  // Results of following the valley along each direction that the data do not determine: the range of each parameter
  // there (empty: it does not move), φ on the way (q × points), and the number of such directions.
  std::vector<std::optional<Interval>> reach = {};
  Matrix alternatives = {};
  Index unknown_directions = 0;

  /// 95 %, of each parameter whatever the others are, inside its box.
  std::vector<Interval> intervals() const;
};

/// The effect of the misfit, which the prior cannot explain, on intervals. Both numbers were chosen on other data than
/// that of docs/results/phi-intervals.md.
struct PhiPosteriorOptions {
  // The misfit counts as so many observations for each degree of freedom of what explains it, however many rows there
  // are. Large: as many as rows, which is overconfident where a parameter that is not tuned is wrong.
  double misfit_observations = 2;
  double misfit_share = 0.6;  // without GPs there is no share
  void fields(FieldVisitor& v) {
    v.number("misfit_observations", misfit_observations, expert(kObservations), above(0));
    v.number("misfit_share", misfit_share,
             expert("standard deviation of the fraction of the GPs' correction that wrong parameters cause"),
             at_least(0));
  }
  static constexpr const char* kObservations =
      "observations per degree of freedom of the prior's model error; fewer: wider intervals";
};

/// The posterior at φ of a space's continuous parameters, whose covariance in fractions of their boxes has the first
/// rows and columns of `covariance`; empty if there are none, or a number is not finite.
std::optional<PhiPosterior> posterior_of(const Matrix& covariance, const ParameterSpace& space, const Vector& phi);

/// Laplace's approximation around the fit with its kernels K_e held: with J_e the derivatives of the prior mean of
/// output e, the precision is the sum over the outputs of J_eᵀ K_e⁻¹ J_e (Gauss and Newton's; Rasmussen 2006, section
/// 2.7), plus that of a uniform distribution in the box. What φ cannot explain looks like the prior's own doing, so
/// that GPs alone take it for far less than it is (Brynjarsdóttir and O'Hagan 2014). Two things are added.
/// - K_e has the misfit's mean square × rows / (misfit_observations × the GP's degrees of freedom) added in each
///   direction of J_e, as if each of these had an equal share of it. The misfit is the part of the residuals that the
///   GP predicts from other rows; its degrees of freedom are the trace of the matrix that smooths the rows (Rasmussen
///   2006, section 2.6).
/// - What a GP explains, φ may have to explain. The way that φ would go for all of it, times misfit_share, counts as a
///   standard deviation: 1/√3 if any share is as likely as any other.
/// Along directions of which the data alone tell less than a tenth of the boxes, or no more than derivatives by
/// differences can resolve, the normal distribution is not trusted: there the sum of squares itself says how far φ may
/// go (reach.hpp). Empty if the prior has no continuous parameter or the fit no finite score, or if a number is not
/// finite.
std::optional<PhiPosterior> phi_posterior(const FitProblem& problem, const Fit& fit,
                                          const PhiPosteriorOptions& options);

/// The same where errors of measurements make steps depend on one another (smoothing.hpp): `steps` has the residuals of
/// all outputs and their covariance C, which takes the place of the K_e. `fit` is of the rows that GPs learn from,
/// and tells the misfits.
std::optional<PhiPosterior> phi_posterior(const FitProblem& problem, const Fit& fit, const ErrorsInVariables& steps,
                                          const PhiPosteriorOptions& options);

/// The same around a φ of least squares, without GPs: the residuals' variance takes the place of K_e, and the misfit is
/// what rows of nearly the same input have in common, of one degree of freedom.
std::optional<PhiPosterior> phi_posterior(const dynamics::Residuals& residuals, const prior::Prior& prior,
                                          const Vector& phi, double misfit_observations, const Evaluator& evaluator);

}  // namespace rehearse::identification
