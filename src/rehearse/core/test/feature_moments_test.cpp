#include "rehearse/core/feature_moments.hpp"

#include <gtest/gtest.h>

#include "gaussian_tools.hpp"

namespace rehearse {
namespace {

const FeatureMap kFeatures({StateKind::plain, StateKind::angle, StateKind::omitted, StateKind::plain,
                            StateKind::angle});

TEST(FeatureMoments, AreThoseOfTheFeatureMap) {
  const Gaussian x = tools::random_gaussian(5, 0.6, 1);
  const auto features = [&](const Vector& at, const Vector&) {
    Matrix F(1, kFeatures.features());
    kFeatures.apply(at.transpose(), F);
    return Vector(F.row(0).transpose());
  };
  tools::expect_samples(features, x, FeatureMoments(kFeatures)(x), 2);

  const Gaussian certain{x.mean, Matrix::Zero(5, 5)};
  const Transformed at_mean = FeatureMoments(kFeatures)(certain);
  EXPECT_LT((at_mean.mean - features(x.mean, {})).norm(), 1e-15);
  EXPECT_EQ(at_mean.covariance, Matrix::Zero(6, 6));
}

TEST(FeatureMoments, AdjointAgreesWithDifferences) {
  const Gaussian x = tools::random_gaussian(5, 0.6, 3);
  const FeatureMoments moments(kFeatures);
  const Transformed by = tools::random_adjoint(5, 6, 4);
  Gaussian adjoint = Gaussian::zero(5);
  moments.adjoint(x, moments(x), by, adjoint);
  tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, moments(at)); }, x, adjoint);
}

}  // namespace
}  // namespace rehearse
