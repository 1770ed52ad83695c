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

TEST(DynamicsModel, IsUncertainAndMeasuredExactlyUnlessItSaysOtherwise) {
  EXPECT_FALSE(Doubling().certain());
  EXPECT_EQ(Doubling().measurement_std().size(), 0);
}

}  // namespace
}  // namespace rehearse::dynamics
