#pragma once

#include <optional>

#include "rehearse/identification/fit_problem.hpp"
#include "rehearse/identification/smoothing/errors_in_variables.hpp"

namespace rehearse::identification {

/// The states of episodes, estimated from noisy measurements and a model learned from them.
struct Smoothed {
  Dataset data;  // smoothed states, and changes that differ from φ's by white noise and what GPs have to learn
  Fit fit;       // φ, and kernels, fitted to them; the score is the log evidence of the measured rows, nats
  Vector measurement_std;   // dx
  ErrorsInVariables steps;  // r and C of the measured rows
};

/// Errors in variables. With measurements y = x + v the residual of a step is, linear in v,
///
///   r_t = g(x_t, u_t) + w_t + v_{t+1} − J_t v_t,
///
/// g the GPs, w white noise, J the slopes of the next state's mean: normal, with a covariance C in which the steps of
/// an episode share measurements. In turn, and linear around what was found last,
/// - φ minimises r' C⁻¹ r: generalised least squares, which several steps tell more of than each of them alone;
/// - the variances of v become likelier (the steps of Zhou 2019);
/// - what is expected of v is subtracted from the measurements;
/// - each kernel is fitted to r with the covariance that v gives it, the other outputs given.
/// These turns climb the product of likelihoods: other scores and searches must leave φ where they found it.
///
/// GPs learn from targets whose white noise leaves as much information about g as C does: with what is expected of g,
/// ĝ, and α = C⁻¹ r they are ĝ + s α, and under noise s the variances of g at the rows are the same on average.
///
/// The misfit of a prior may look like noise, but not like this noise, which is in the step before a measurement and
/// in the one after. So the evidence must be higher, by the price of dx variances (Schwarz 1978: dx/2 ln n dx), than
/// - that of GPs at this φ without errors, whose kernels are fitted as carefully and from where these ended;
/// - with the same errors if no two steps shared a measurement.
///
/// `fit` is one of the rows as measured; its kernels must have been fitted. φ stays unless `moves_phi`. Empty
/// where these measurements are not clearly likelier; if a row's prior mean, or another number, is not finite; and with
/// more than 12 states, since the cost grows with their cube and the rows'. Rows beyond 800 / dx are in blocks of their
/// own, between which only GPs and φ are shared. Any thread.
std::optional<Smoothed> smooth(const FitProblem& problem, const Fit& fit, bool moves_phi);

}  // namespace rehearse::identification
