#pragma once
// The information of residuals near a point about parameters: a precision, a gradient, directions without information.

#include <functional>

#include "rehearse/core/types.hpp"

namespace rehearse::identification {

/// Residuals y (n) near a point z ∈ [0, 1]^q, fractions of the boxes: their derivatives J (n × q) with the errors of
/// these, and L⁻¹ of columns, with K = L Lᵀ their covariance.
struct NearResiduals {
  Vector y;
  Matrix derivatives, errors;
  std::function<Matrix(const Matrix&)> whiten;
};

struct Information {
  Matrix factor;    // F (n × q): the precision of z is Fᵀ F, which would lose directions that are hardly known
  Vector gradient;  // q, of the log evidence
  Matrix data;      // F of the data alone, without the misfit
  Matrix errors;    // q × q, the Gram matrix of those of the whitened derivatives
};

/// The information of residuals of covariance K + A Aᵀ; `misfit` is A (n × any). Empty if a number is not finite.
Information information(const NearResiduals& residuals, const Matrix& misfit);

/// √variance times an orthonormal basis of the columns of J (n × q), n × its rank: a misfit in all of these directions.
Matrix spread_over(const Matrix& J, double variance);

/// The covariance (q × q) of z, under a uniform distribution in the box, too. Where the search stopped short of the
/// best z in the box, the way that is left counts as a standard deviation.
Matrix covariance_of(const Information& information, const Vector& z);

/// The directions (q × some) that the data alone leave to the boxes.
Matrix weak_directions(const Information& information);

/// The step (q) from z, inside the box, by which parameters would explain, by least squares, the part `explained` (n)
/// of the residuals; deviations (n): of the residuals.
Vector way_to_explain(const Matrix& J, const Vector& explained, const Vector& deviations, const Vector& z);

}  // namespace rehearse::identification
