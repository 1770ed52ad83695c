#include "rehearse/moments/feature_moments.hpp"

#include <gtest/gtest.h>

#include "gaussian_tools.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::moments {
namespace {

using enum StateKind;
const FeatureMap kFeatures({plain, angle, omitted, plain, angle});
const FeatureMap kWithJoints({plain, angle, omitted, plain, angle, angle}, {{4, 1}, {5, 4}});

Vector apply(const FeatureMap& map, const Vector& state) {
  Matrix F(1, map.features());
  map.apply(state.transpose(), F);
  return F.row(0).transpose();
}

TEST(FeatureMoments, AreThoseOfTheFeatureMap) {
  for (const FeatureMap& map : {kFeatures, kWithJoints}) {
    const Index dx = map.states(), n = map.features();
    const Gaussian x = tools::random_gaussian(dx, 0.6, 1);
    const auto features = [&](const Vector& at, const Vector&) { return apply(map, at); };
    tools::expect_samples(features, x, FeatureMoments(map)(x), 2);

    const Gaussian certain{x.mean, Matrix::Zero(dx, dx)};
    const Transformed at_mean = FeatureMoments(map)(certain);
    EXPECT_LT((at_mean.mean - apply(map, x.mean)).norm(), 1e-15);
    EXPECT_EQ(at_mean.covariance, Matrix::Zero(n, n));
  }
}

TEST(FeatureMoments, AdjointAgreesWithDifferences) {
  for (const FeatureMap& map : {kFeatures, kWithJoints}) {
    const Gaussian x = tools::random_gaussian(map.states(), 0.6, 3);
    const FeatureMoments moments(map);
    const Transformed by = tools::random_adjoint(map.states(), map.features(), 4);
    Gaussian adjoint = Gaussian::zero(map.states());
    moments.adjoint(x, moments(x), by, adjoint);
    tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, moments(at)); }, x, adjoint);
  }
}

// Two links that turn together: their joint's angle is known, whatever theirs are.
TEST(FeatureMoments, OfAJointThatDoesNotMoveAreKnown) {
  const FeatureMoments moments(FeatureMap({angle, angle}, {{1, 0}}));
  const Transformed result = moments({Vector{{0.3, 1.0}}, Matrix::Constant(2, 2, 0.8)});
  EXPECT_NEAR(result.mean(4), std::cos(0.7), 1e-12);
  EXPECT_NEAR(result.mean(5), std::sin(0.7), 1e-12);
  EXPECT_LT(result.covariance.bottomRows(2).norm(), 1e-12);
}

TEST(FeatureMoments, RefuseAStateOfAnotherSize) {
  const FeatureMoments moments(kFeatures);
  EXPECT_THROW(moments(Gaussian::zero(4)), InvalidInput);
  EXPECT_THROW(moments({Vector::Zero(5), Matrix::Zero(4, 4)}), InvalidInput);
}

}  // namespace
}  // namespace rehearse::moments
