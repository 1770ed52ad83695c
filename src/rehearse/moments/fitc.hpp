#pragma once
// GPs of many points by few inducing inputs Z (m × D) that the outputs share: FITC (Snelson 2006), PILCO's for more
// than 300 rows, with m = 300. `ridge`, as a fraction of the signal's variance, is added to the variance of the
// inducing inputs (PILCO: 1e-6 whatever the signal, which drowns states that change little in their unit).

#include <vector>

#include "rehearse/moments/moment_term.hpp"

namespace rehearse::moments {

inline constexpr double kFitcRidge = 1e-6;

/// GPs of Y (n × E) at inputs X (n × D): each is like a GP of m points. Throws InvalidInput on wrong sizes, and where a
/// matrix cannot be factorised.
std::vector<MomentTerm> fitc_terms(const ConstMatrixView& X, const ConstMatrixView& Y, const ConstMatrixView& Z,
                                   const std::vector<gp::Hyperparameters>& hyperparameters, double ridge = kFitcRidge);

/// The log evidence in nats of targets y (n) of one output at inputs X (n × D), and, unless null, its gradient with
/// respect to Z (m × D). Both NaN where a matrix cannot be factorised. Throws InvalidInput on wrong sizes. Any thread.
double fitc_evidence(const ConstMatrixView& X, const ConstVectorView& y, const ConstMatrixView& Z,
                     const gp::Hyperparameters& hyperparameters, Matrix* gradient = nullptr, double ridge = kFitcRidge);

}  // namespace rehearse::moments
