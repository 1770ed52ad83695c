#pragma once

#include <vector>

#include "rehearse/identification/score.hpp"

namespace rehearse::identification {

/// The outputs' log likelihoods near a point as functions of the step d (q) from there:
/// ℓ_e(d) = values_e + gradients_eᵀ d − ½ dᵀ curvatures_e d.
struct Quadratics {
  Vector values;                   // E
  Matrix gradients;                // q × E
  std::vector<Matrix> curvatures;  // E of q × q, symmetric, no eigenvalue below 0

  Vector at(const Vector& d) const;
};

/// The d within low ≤ d ≤ high (low ≤ 0 ≤ high) where the score of the quadratics less ½ damping Σ_i D_i d_i² is
/// highest, with D the diagonal of the score's own curvature at 0. For a sum, which may have several maxima, one of
/// them. Newton's method on the active set; q is small.
Vector best_step(const Quadratics& quadratics, Score score, const Vector& low, const Vector& high, double damping);

}  // namespace rehearse::identification
