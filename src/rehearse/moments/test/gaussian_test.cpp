#include "rehearse/moments/gaussian.hpp"

#include <gtest/gtest.h>

#include "gaussian_tools.hpp"

namespace rehearse::moments {
namespace {

TEST(AffineMoments, AgreeWithSamplesAndTheirAdjointWithDifferences) {
  const Gaussian x = tools::random_gaussian(4, 0.5, 1);
  const Matrix A = tools::normals(2, 4, 2);
  const Vector b = tools::normals(2, 1, 3);
  tools::expect_samples([&](const Vector& at, const Vector&) { return Vector(A * at + b); }, x, affine_moments(A, b, x),
                        4);

  const Transformed by = tools::random_adjoint(4, 2, 5);
  Gaussian x_adjoint = Gaussian::zero(4);
  Matrix A_adjoint = Matrix::Zero(2, 4);
  Vector b_adjoint = Vector::Zero(2);
  affine_adjoint(A, x, by, x_adjoint, A_adjoint, b_adjoint);
  tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, affine_moments(A, b, at)); }, x, x_adjoint);
  const Vector by_A = tools::slopes(
      [&](const Vector& a) { return tools::inner(by, affine_moments(a.reshaped(2, 4), b, x)); }, A.reshaped(), 1e-3);
  EXPECT_LT((by_A - A_adjoint.reshaped()).norm(), 1e-9 * by_A.norm());
  const Vector by_b =
      tools::slopes([&](const Vector& at) { return tools::inner(by, affine_moments(A, at, x)); }, b, 1e-3);
  EXPECT_LT((by_b - b_adjoint).norm(), 1e-9 * by_b.norm());
}

}  // namespace
}  // namespace rehearse::moments
