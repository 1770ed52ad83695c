#pragma once

#include <cmath>

#include <Eigen/LU>

#include "rehearse/policy/rbf_kernel.hpp"

namespace rehearse::policy::naive {

/// The mean of a GP in textbook form; theta in the order that rbf.hpp says.
inline double mean(const Vector& theta, const Vector& x, const RbfShape& shape, Index action) {
  const auto [D, centres, actions, noise] = shape;
  const Vector lengths = theta.segment(action * D, D).array().exp();
  const auto centre = [&](Index i) -> Vector { return theta.segment(actions * D + i * D, D); };
  const Vector targets = theta.segment(actions * D + centres * D + action * centres, centres);
  const auto k = [&](const Vector& a, const Vector& b) {
    return std::exp(-0.5 * ((a - b).array() / lengths.array()).square().sum());
  };
  Matrix K(centres, centres);
  Vector kx(centres);
  for (Index i = 0; i < centres; ++i) {
    kx(i) = k(x, centre(i));
    for (Index j = 0; j < centres; ++j) K(i, j) = k(centre(i), centre(j)) + (i == j ? noise * noise : 0);
  }
  return kx.dot(K.fullPivLu().solve(targets));
}

}  // namespace rehearse::policy::naive
