#define INTEGRATE_SINES
#include "angles.hpp"

namespace rehearse::system {
namespace {

TEST(IntegratedSines, AreAsExactAsTheSteps) {
  const Matrix X = 3 * Matrix::Random(21, 4), U = Matrix::Random(21, 2), exact = by_function(X, U, 200);
  const auto error = [&](Index substeps) { return (by_kernel(X, U, substeps) - exact).cwiseAbs().maxCoeff(); };
  EXPECT_LT(error(8), 1e-7);
  const double ratio = error(8) / error(16);  // the fifth order: 2^5
  EXPECT_GT(ratio, 20);
  EXPECT_LT(ratio, 50);
}

TEST(IntegratedSines, OfAnglesBeyondAllReasonAreNanInTheirRowAlone) {
  const Matrix X = Matrix::Random(11, 4), U = Matrix::Random(11, 2), clean = by_kernel(X, U, 4);
  Matrix far = X;
  far(4, 2) = 1e7;
  const Matrix dX = by_kernel(far, U, 4);
  for (Index i = 0; i < 11; ++i) EXPECT_TRUE(i == 4 ? dX.row(i).array().isNaN().all() : dX.row(i) == clean.row(i)) << i;
}

}  // namespace
}  // namespace rehearse::system
