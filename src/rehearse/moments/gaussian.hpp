#pragma once
// Gaussians and their moments through functions: the values that moment matching hands from piece to piece
// (Deisenroth 2011). Every piece has an adjoint: from the derivatives of a number with respect to each of its results
// it adds those with respect to its inputs (reverse mode). The adjoint of a value has the value's type; that of a
// covariance takes all its entries as independent.

#include <utility>

#include "rehearse/core/types.hpp"

namespace rehearse::moments {

/// N(mean, covariance) of D variables, or the adjoint of one.
struct Gaussian {
  Vector mean;        // D
  Matrix covariance;  // D × D

  static Gaussian zero(Index size) { return {Vector::Zero(size), Matrix::Zero(size, size)}; }
  Index size() const { return mean.size(); }
};

/// The first two moments of f(x), E outputs, where x ~ N(m, s) has D variables, and how f(x) goes with x.
struct Transformed {
  Vector mean;        // E
  Matrix covariance;  // E × E
  Matrix gain;        // D × E: s⁻¹ cov[x, f(x)], which also exists where s is singular (PILCO's V and C)

  static Transformed zero(Index inputs, Index outputs) {
    return {Vector::Zero(outputs), Matrix::Zero(outputs, outputs), Matrix::Zero(inputs, outputs)};
  }
  Index outputs() const { return mean.size(); }
};

/// A x + b: the moments of a linear policy (Deisenroth 2010, section 3.5). A: E × D, b: E.
inline Transformed affine_moments(const Matrix& A, const Vector& b, const Gaussian& x) {
  return {A * x.mean + b, A * x.covariance * A.transpose(), A.transpose()};
}

/// Adds to the adjoints of x, A and b those that the adjoint of the result brings.
inline void affine_adjoint(const Matrix& A, const Gaussian& x, const Transformed& adjoint, Gaussian& x_adjoint,
                           Matrix& A_adjoint, Vector& b_adjoint) {
  const Matrix symmetric = adjoint.covariance + adjoint.covariance.transpose();
  x_adjoint.mean += A.transpose() * adjoint.mean;
  x_adjoint.covariance += A.transpose() * adjoint.covariance * A;
  A_adjoint += adjoint.mean * x.mean.transpose() + symmetric * A * x.covariance + adjoint.gain.transpose();
  b_adjoint += adjoint.mean;
}

}  // namespace rehearse::moments
