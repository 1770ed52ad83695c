#include "rehearse/core/feature_slopes.hpp"

#include <gtest/gtest.h>

namespace rehearse {
namespace {

TEST(FeatureSlopes, PullDerivativesBackToStates) {
  const FeatureMap map({StateKind::angle, StateKind::plain, StateKind::omitted, StateKind::angle}, {{3, 0}}, {-1, 1});
  const Matrix X = Matrix::Random(5, 4), U = Matrix::Random(5, 2), weights = Matrix::Random(5, 9);
  const auto value = [&](const Matrix& at) {  // of each row
    Matrix F(5, 9);
    map.apply(at, F.leftCols(7));
    map.apply_actions(at, U, F.rightCols(2));
    return Vector(F.cwiseProduct(weights).rowwise().sum());
  };
  Matrix F(5, 7), by(5, 4);
  map.apply(X, F);
  pull_back_features(map, F, weights.leftCols(7), by);
  pull_back_targets(map, weights.rightCols(2), by);
  for (Index s = 0; s < 4; ++s) {
    Matrix more = X, less = X;
    more.col(s).array() += 1e-5;
    less.col(s).array() -= 1e-5;
    EXPECT_LT((by.col(s) - (value(more) - value(less)) / 2e-5).norm(), 1e-9) << s;
  }
}

}  // namespace
}  // namespace rehearse
