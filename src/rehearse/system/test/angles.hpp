#pragma once
// The same pendulums as a function, and the kernel of pendulums.hpp.

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/system/plain_kernel.hpp"

#define REHEARSE_EQUATION "rehearse/system/test/pendulums.hpp"
#include "rehearse/system/equation_kernel.hpp"

namespace rehearse::system {
namespace {

const Vector kStiffness{{5}};

void pendulums(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  const double pull = phi(0) * std::sin(x(1) - x(3));
  dxdt << u(0) - 9.82 * std::sin(x(1)) - pull, x(0), u(1) + pull - 9.82 * std::sin(x(3)), x(2);
}

Matrix by_kernel(const Matrix& X, const Matrix& U, Index substeps) {
  Matrix dX(X.rows(), 4);
  equation_kernel().change(X, U, kStiffness.data(), 0.1, substeps, dX);
  return dX;
}

Matrix by_function(const Matrix& X, const Matrix& U, Index substeps) {
  Matrix dX(X.rows(), 4);
  make_ode_simulator(pendulums, {}, 0.1, substeps)->change(X, U, kStiffness, dX);
  return dX;
}

}  // namespace
}  // namespace rehearse::system
