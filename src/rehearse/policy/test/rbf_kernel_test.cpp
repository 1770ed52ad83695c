#include "rehearse/policy/rbf_kernel.hpp"

#include <gtest/gtest.h>

#include "fixture.hpp"
#include "naive_rbf.hpp"

namespace rehearse::policy {
namespace {

using fixture::normals;

TEST(RbfKernel, IsItsFormulaForAnyNumberOfRowsAndStrides) {
  const RbfShape shape{.inputs = 3, .centres = 4, .actions = 2, .noise = 0.05};
  for (Index rows = 1; rows <= 19; ++rows) {
    const Matrix Theta = normals(rows + 3, shape.parameters(), 1), X = normals(rows + 5, 3, 2);
    Matrix out = Matrix::Constant(rows + 1, 2, 7);
    rbf(shape, Theta.data(), Theta.rows(), X.data(), X.rows(), out.data(), out.rows(), rows);
    for (Index r = 0; r < rows; ++r)
      for (Index a = 0; a < 2; ++a)
        EXPECT_NEAR(out(r, a), naive::mean(Theta.row(r), X.row(r), shape, a), 1e-10) << rows << " " << r;
    EXPECT_EQ(out.row(rows), Matrix::Constant(1, 2, 7)) << "nothing is written behind the last row";
  }
}

// A thread keeps the factorisation of the θ before.
TEST(RbfKernel, AnotherShapeOfAsManyParametersIsNotTakenForTheLast) {
  const Matrix theta = normals(1, 12, 1), x = normals(1, 3, 2);
  const RbfShape one{.inputs = 1, .centres = 5, .actions = 1, .noise = 0.1},
      other{.inputs = 1, .centres = 5, .actions = 1, .noise = 0.5},
      wide{.inputs = 3, .centres = 2, .actions = 1, .noise = 0.1};
  for (int again = 0; again < 2; ++again)
    for (const RbfShape& shape : {one, other, wide}) {
      double out = 0;
      rbf(shape, theta.data(), 1, x.data(), 1, &out, 1, 1);
      const Vector own_theta = theta.row(0).head(shape.parameters()).transpose(),
                   input = x.row(0).head(shape.inputs).transpose();
      EXPECT_NEAR(out, naive::mean(own_theta, input, shape, 0), 1e-10) << shape.noise << " " << shape.inputs;
    }
}

TEST(RbfKernel, ChangedParametersOfAnyActionAreNotTakenForTheLast) {
  const RbfShape shape{.inputs = 2, .centres = 4, .actions = 3, .noise = 0.1};
  const Matrix x = normals(1, 2, 2);
  Matrix theta = normals(1, shape.parameters(), 1), out(1, 3);
  for (Index changed = 0; changed < shape.parameters(); ++changed) {
    theta(0, changed) += 0.1;
    rbf(shape, theta.data(), 1, x.data(), 1, out.data(), 1, 1);
    for (Index a = 0; a < 3; ++a)
      EXPECT_NEAR(out(0, a), naive::mean(theta.row(0), x.row(0), shape, a), 1e-10) << changed << " " << a;
  }
}

}  // namespace
}  // namespace rehearse::policy
