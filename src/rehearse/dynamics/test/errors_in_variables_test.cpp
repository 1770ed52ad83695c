#include "rehearse/dynamics/errors_in_variables.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse::dynamics {
namespace {

// Rows 0 and 1 follow each other, row 2 is on its own; two states, of which an error before moves both residuals.
TEST(ErrorsInVariables, CovarianceIsThatOfDrawnErrors) {
  const Block block{.first = 0, .rows = 3, .first_measurement = 0, .measurements = 5, .before = {0, 1, 3}};
  Rng rng({.purpose = Purpose::test});
  const auto normals = [&](Index rows) {
    Matrix A(rows, 2);
    for (double& a : A.reshaped()) a = rng.normal();
    return A;
  };
  const std::vector<Matrix> before{normals(3), normals(3)}, after{normals(3), normals(3)};
  const Vector R{{0.5, 2}}, W{{0.1, 0.3}};
  const ErrorsInVariables errors{.K = {Matrix::Identity(3, 3), 2 * Matrix::Ones(3, 3)},
                                 .B = errors_of(block, before, after)};
  constexpr int kDraws = 100000;
  Matrix sum = Matrix::Zero(6, 6);
  for (int i = 0; i < kDraws; ++i) {
    const Matrix v = normals(5) * R.cwiseSqrt().asDiagonal();
    Matrix r = Matrix::Zero(3, 2);
    for (Index row = 0; row < 3; ++row) {
      const Index from = block.before[static_cast<std::size_t>(row)];
      for (Index d = 0; d < 2; ++d)
        r.row(row) += v(from, d) * before[static_cast<std::size_t>(d)].row(row) +
                      v(from + 1, d) * after[static_cast<std::size_t>(d)].row(row);
    }
    sum += r.reshaped() * r.reshaped().transpose();
  }
  const Matrix drawn = sum / kDraws, S = errors.covariance_of_errors(R);
  EXPECT_LT((S - drawn).cwiseAbs().maxCoeff(), 0.03 * drawn.cwiseAbs().maxCoeff());
  Matrix rest = errors.covariance(R, W) - S;
  EXPECT_NEAR(rest(0, 0), 1.1, 1e-12);
  EXPECT_NEAR(rest(0, 1), 0, 1e-12);
  EXPECT_NEAR(rest(3, 3), 2.3, 1e-12);
  EXPECT_NEAR(rest(3, 4), 2, 1e-12);
  EXPECT_NEAR(rest(2, 3), 0, 1e-12);
}

}  // namespace
}  // namespace rehearse::dynamics
