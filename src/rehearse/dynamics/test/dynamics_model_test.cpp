#include "rehearse/dynamics/dynamics_model.hpp"

#include <gtest/gtest.h>

namespace rehearse::dynamics {
namespace {

/// Twice the state, with a variance of its square.
class Doubling final : public DynamicsModel {
 public:
  void predict(const ConstMatrixView& X, const ConstMatrixView&, MatrixView mean, MatrixView variance) const override {
    mean = 2 * X;
    variance = X.cwiseAbs2();
  }
};

TEST(DynamicsModel, ASampleIsTheMeanAndSoManyDeviations) {
  const Matrix X{{1, -2}, {3, 0}}, normals{{0.5, 1}, {-1, 4}}, U = Matrix::Zero(2, 1);
  Matrix change(2, 2), mean(2, 2);
  const Doubling model;
  model.sample(X, U, normals, change);
  EXPECT_TRUE(change.isApprox(Matrix{{2.5, -2}, {3, 0}}));
  model.sample(X, U, Matrix::Zero(2, 2), change);
  model.predict_mean(X, U, mean);
  EXPECT_EQ(change, 2 * X);
  EXPECT_EQ(mean, 2 * X);
}

/// The product of state and action, and a square.
class Product final : public DynamicsModel {
 public:
  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
               MatrixView variance) const override {
    mean.col(0) = X.col(0).cwiseProduct(U.col(0));
    mean.col(1) = X.col(1) + 3 * U.col(0);
    variance.col(0) = X.col(1).cwiseAbs2();
    variance.col(1).setConstant(2);
  }
};

TEST(DynamicsModel, IsLinearisedByDifferences) {
  const Matrix X{{1, -2}, {300, 0.5}}, U{{0.5}, {-7}};
  Linearised at;
  Product().linearise(X, U, at);
  EXPECT_TRUE(at.mean.isApprox(Matrix{{0.5, -0.5}, {-2100, -20.5}}));
  EXPECT_TRUE(at.variance.isApprox(Matrix{{4, 2}, {0.25, 2}}));
  EXPECT_TRUE(at.mean_by.isApprox(Matrix{{0.5, 0, 1, 0, 1, 3}, {-7, 0, 300, 0, 1, 3}}, 1e-9)) << at.mean_by;
  EXPECT_TRUE(at.variance_by.isApprox(Matrix{{0, -4, 0, 0, 0, 0}, {0, 1, 0, 0, 0, 0}}, 1e-9)) << at.variance_by;
}

TEST(DynamicsModel, IsUncertainAndMeasuredExactlyUnlessItSaysOtherwise) {
  EXPECT_FALSE(Doubling().certain());
  EXPECT_EQ(Doubling().measurement_std().size(), 0);
}

}  // namespace
}  // namespace rehearse::dynamics
