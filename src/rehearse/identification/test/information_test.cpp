#include "rehearse/identification/information.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse::identification {
namespace {

Matrix random_numbers(Index rows, Index columns, std::uint64_t seed) {
  Rng rng({.seed = seed});
  return Matrix::NullaryExpr(rows, columns, [&] { return rng.normal(); });
}

/// Twelve residuals of three parameters whose covariance is K.
struct Example {
  Matrix root = random_numbers(12, 12, 1) + 4 * Matrix::Identity(12, 12), K = root * root.transpose();
  NearResiduals near{
      random_numbers(12, 1, 2), random_numbers(12, 3, 3), Matrix::Zero(12, 3),
      [L = Matrix(K.llt().matrixL())](const Matrix& X) -> Matrix { return L.triangularView<Eigen::Lower>().solve(X); }};
};

TEST(Information, IsThatOfTheCovarianceWithTheMisfit) {
  const Example example;
  const Matrix A = random_numbers(12, 2, 4), &J = example.near.derivatives;
  const Information told = information(example.near, A);
  const Matrix inverse = (example.K + A * A.transpose()).inverse();
  EXPECT_LT((told.factor.transpose() * told.factor - J.transpose() * inverse * J).norm(), 1e-12);
  EXPECT_LT((told.gradient + J.transpose() * inverse * example.near.y).norm(), 1e-12);
  EXPECT_LT((told.data.transpose() * told.data - J.transpose() * example.K.inverse() * J).norm(), 1e-12);
}

TEST(Information, WithoutAMisfitIsThatOfTheDataAlone) {
  const Example example;
  const Information told = information(example.near, Matrix(12, 0));
  EXPECT_EQ(told.factor, told.data);
}

TEST(Information, OfWhatIsNotFiniteThereIsNone) {
  Example example;
  example.near.y(3) = std::nan("");
  EXPECT_EQ(information(example.near, Matrix(12, 0)).factor.size(), 0);
}

TEST(Information, AMisfitIsSpreadOverTheDirectionsOfItsColumnsAlone) {
  Matrix J = random_numbers(12, 3, 5);
  J.col(2) = J.col(0) - 2 * J.col(1);
  const Matrix A = spread_over(J, 9);
  ASSERT_EQ(A.cols(), 2);
  EXPECT_LT((A.transpose() * A - 9 * Matrix::Identity(2, 2)).norm(), 1e-12);
  EXPECT_LT((A * (A.transpose() * J) / 9 - J).norm(), 1e-12);
  EXPECT_EQ(spread_over(J, 0).cols(), 0);
}

TEST(Information, ADirectionThatNothingTellsIsWeakAndHasTheDeviationOfTheBox) {
  Example example;
  example.near.derivatives *= 100;
  example.near.derivatives.col(1).setZero();
  const Information told = information(example.near, Matrix(12, 0));
  const Matrix weak = weak_directions(told);
  ASSERT_EQ(weak.cols(), 1);
  EXPECT_NEAR(std::abs(weak(1, 0)), 1, 1e-12);
  EXPECT_NEAR(covariance_of(told, Vector{{0.5, 0.5, 0.5}})(1, 1), 1.0 / 12, 1e-12);
}

TEST(Information, TheWayExplainsWhatIsOfTheParametersAndStaysInTheBox) {
  const Matrix J = random_numbers(12, 3, 6);
  const Vector way{{0.1, -0.2, 0.05}}, z{{0.5, 0.5, 0.5}}, deviations = Vector::Constant(12, 1e-3);
  EXPECT_LT((way_to_explain(J, -J * way, deviations, z) - way).norm(), 1e-4);
  EXPECT_LT((way_to_explain(J, J * way, deviations, Vector{{0.05, 0.5, 0.5}}) - Vector{{-0.05, 0.2, -0.05}}).norm(),
            1e-4);
}

}  // namespace
}  // namespace rehearse::identification
