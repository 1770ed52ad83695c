#pragma once
// The spread of residuals, and the part of them that is no noise: a misfit of the prior.

#include <functional>
#include <vector>

#include "rehearse/gp/hyperparameters.hpp"
#include "rehearse/gp/inputs.hpp"
#include "rehearse/identification/fit_problem.hpp"

namespace rehearse::identification {

inline constexpr double kLeastDeviation = 1e-6;  // of residuals, as a fraction of the changes: gp::Bounds' floor

/// An output's residuals y (n): their covariance K = L Lᵀ and their misfit.
struct Spread {
  std::function<Matrix(const Matrix&)> whiten;  // L⁻¹
  double misfit;                                // mean square, of a GP a degree of freedom
  Vector explained = {};                        // n, of y by the GP; empty without one
};

/// The spread of residuals to which a GP was fitted: the misfit is what it predicts of each row from the others,
/// `explained` its posterior mean.
Spread spread_of_gp(const gp::Inputs& inputs, const gp::Hyperparameters& kernel, const ConstVectorView& y);

/// The row nearest to each in the space of the inputs, of equals the first; of a single row itself.
std::vector<Index> nearest_rows(const gp::Inputs& inputs);

/// The spread of y that is white around a smooth function of the inputs: half the mean squared difference of nearest
/// rows is the variance of what is white (the delta test; Pi and Peterson 1994). scale: the deviation of the changes;
/// parameters: of the prior that were fitted.
Spread spread_of_white(const ConstVectorView& y, double scale, Index parameters, const std::vector<Index>& nearest);

}  // namespace rehearse::identification
