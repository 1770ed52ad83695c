#include "rehearse/core/feature_map.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse {
namespace {

const FeatureMap kMap({StateKind::plain, StateKind::omitted, StateKind::angle, StateKind::plain});

TEST(FeatureMap, CountsAndNames) {
  EXPECT_EQ(kMap.states(), 4);
  EXPECT_EQ(kMap.features(), 4);
  EXPECT_EQ(kMap.names({"v", "x", "theta", "w"}), (std::vector<std::string>{"v", "cos theta", "sin theta", "w"}));
  EXPECT_EQ(FeatureMap().features(), 0);
}

TEST(FeatureMap, AnglesBecomeCosineAndSine) {
  Matrix X(3, 4), F(3, 4);
  X << 1, 2, 0.5, 4, 5, 6, -3, 8, 9, 10, M_PI / 2, 12;
  kMap.apply(X, F);
  for (Index i = 0; i < 3; ++i) {
    EXPECT_EQ(F(i, 0), X(i, 0));
    EXPECT_NEAR(F(i, 1), std::cos(X(i, 2)), 1e-15);
    EXPECT_NEAR(F(i, 2), std::sin(X(i, 2)), 1e-15);
    EXPECT_EQ(F(i, 3), X(i, 3));
  }
}

TEST(FeatureMap, JointAnglesComeLast) {
  const FeatureMap map({StateKind::angle, StateKind::plain, StateKind::angle}, {{.angle = 2, .parent = 0}});
  EXPECT_EQ(map.features(), 7);
  EXPECT_EQ(map.names({"a", "v", "b"}),
            (std::vector<std::string>{"cos a", "sin a", "v", "cos b", "sin b", "cos(b - a)", "sin(b - a)"}));
  const Matrix X = 4 * Matrix::Random(5, 3);
  Matrix F(5, 7), without(5, 5);
  map.apply(X, F);
  FeatureMap(map.kinds()).apply(X, without);
  EXPECT_EQ(F.leftCols(5), without);
  for (Index i = 0; i < 5; ++i) {
    EXPECT_NEAR(F(i, 5), std::cos(X(i, 2) - X(i, 0)), 1e-15);
    EXPECT_NEAR(F(i, 6), std::sin(X(i, 2) - X(i, 0)), 1e-15);
  }
}

TEST(FeatureMap, RefusesJointsOfOtherStates) {
  for (const Index wrong : {Index{-1}, Index{1}, Index{3}})
    EXPECT_THROW(FeatureMap({StateKind::angle, StateKind::plain, StateKind::angle}, {{2, wrong}}), InvalidInput);
}

TEST(FeatureMap, TargetsCountFromTheirStates) {
  const FeatureMap map({StateKind::plain, StateKind::omitted}, {}, {1, -1, 0});
  const Matrix X{{1, 2}, {3, 4}}, U{{10, 20, 30}, {40, 50, 60}}, expected{{8, 20, 29}, {36, 50, 57}};
  Matrix F(2, 3);
  map.apply_actions(X, U, F);
  EXPECT_EQ(F, expected);
  FeatureMap(map.kinds()).apply_actions(X, U, F);
  EXPECT_EQ(F, U);
}

TEST(FeatureMap, WorksOnBlocks) {
  Matrix X = Matrix::Random(9, 6), F = Matrix::Constant(9, 6, 7), whole(5, 4);
  kMap.apply(X.block(2, 1, 5, 4), F.block(3, 1, 5, 4));
  const Matrix copy = X.block(2, 1, 5, 4);
  kMap.apply(copy, whole);
  EXPECT_EQ(F.block(3, 1, 5, 4), whole);
  F.block(3, 1, 5, 4).setConstant(7);
  EXPECT_EQ(F, Matrix::Constant(9, 6, 7)) << "nothing else is written";
}

}  // namespace
}  // namespace rehearse
