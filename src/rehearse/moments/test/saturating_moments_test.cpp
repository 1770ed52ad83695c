#include "rehearse/moments/saturating_moments.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "rehearse/core/test/reference.hpp"
#include "rehearse/moments/feature_moments.hpp"
#include "rehearse/moments/test/gaussian_tools.hpp"

namespace rehearse::moments {
namespace {

/// U with Uᵀ U = W.
Matrix root(const Matrix& W) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(W);
  return eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
}

Matrix symmetric(const Matrix& A) { return A + A.transpose(); }

TEST(SaturatingMoments, AgreeWithPilcoIncludingDerivatives) {
  const nlohmann::json pilco = reference::load("d_losses.json");
  for (const auto& test : pilco["lossSat"]) {
    const reward::ClosedForm reward{.goal = reference::vector(test["z"]),
                                    .distances = root(reference::matrix(test["W"]))};
    const RewardMoments moments =
        saturating_moments(reward, {reference::vector(test["m"]), reference::matrix(test["s"])});
    EXPECT_NEAR(1 - moments.mean, test["L"].get<double>(), 1e-8);
    EXPECT_NEAR(moments.variance, test["var"].get<double>(), 1e-8);
    EXPECT_LT(reference::error(-moments.by_mean.mean, reference::matrix(test["dLdm"])), 1e-8);
    EXPECT_LT(reference::error(-moments.by_mean.mean, reference::matrix(test["C"])), 1e-8);
    EXPECT_LT(reference::error(-symmetric(moments.by_mean.covariance), symmetric(reference::matrix(test["dLds"]))),
              1e-8);
  }
}

/// Features and then the reward, with the tasks' feature maps: of the cart-pole and the pendubot.
void expect_agreement_after_features(const FeatureMap& map, const reward::ClosedForm& reward,
                                     const nlohmann::json& tests) {
  const FeatureMoments features(map);
  for (const auto& test : tests["cases"]) {
    const Gaussian state{reference::vector(test["m"]), reference::matrix(test["s"])};
    const Transformed f = features(state);
    const RewardMoments moments = saturating_moments(reward, {f.mean, f.covariance});
    Transformed by = Transformed::zero(4, map.features());
    by.mean = moments.by_mean.mean, by.covariance = moments.by_mean.covariance;
    Gaussian adjoint = Gaussian::zero(4);
    features.adjoint(state, f, by, adjoint);
    EXPECT_NEAR(1 - moments.mean, test["L"].get<double>(), 1e-8);
    EXPECT_NEAR(moments.variance, test["var"].get<double>(), 1e-8);
    const Matrix by_covariance = reference::matrix(test["dLds"]).reshaped(4, 4);
    EXPECT_LT((adjoint.mean + reference::vector(test["dLdm"])).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_LT((symmetric(adjoint.covariance) + symmetric(by_covariance)).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(SaturatingMoments, AgreeWithPilcosTipDistances) {
  using enum StateKind;
  const auto losses = reference::load("d_losses.json");
  const double width = 0.25, l = 0.5;
  expect_agreement_after_features(
      FeatureMap({plain, plain, plain, angle}),
      {.goal = Vector{{0, 0, 0, -1, 0}}, .distances = Matrix{{1, 0, 0, 0, l}, {0, 0, 0, l, 0}} / width},
      losses["loss_cp"]);
  expect_agreement_after_features(
      FeatureMap({plain, plain, angle, angle}),
      {.goal = Vector{{0, 0, 1, 0, 1, 0}}, .distances = Matrix{{0, 0, l, 0, l, 0}, {0, 0, 0, l, 0, l}} / width},
      losses["loss_pendubot"]);
}

TEST(SaturatingMoments, AgreeWithSamplesAndTheirDerivativesWithDifferences) {
  const reward::ClosedForm reward{.goal = tools::normals(3, 1, 1), .distances = tools::normals(2, 3, 2)};
  const Gaussian f{reward.goal + 0.5 * tools::normals(3, 1, 3), tools::random_gaussian(3, 0.4, 4).covariance};
  const RewardMoments moments = saturating_moments(reward, f);
  const auto value = [&](const Vector& at, const Vector&) {
    return Vector::Constant(1, std::exp(-(reward.distances * (at - reward.goal)).squaredNorm() / 2)).eval();
  };
  tools::expect_samples(
      value, f, {Vector::Constant(1, moments.mean), Matrix::Constant(1, 1, moments.variance), moments.by_mean.mean}, 5);
  tools::expect_slopes([&](const Gaussian& at) { return saturating_moments(reward, at).mean; }, f, moments.by_mean);
}

TEST(SaturatingMoments, OfWhatIsNoGaussianAreNotFinite) {
  const reward::ClosedForm reward{.goal = Vector::Zero(1), .distances = Matrix::Identity(1, 1)};
  EXPECT_TRUE(std::isnan(saturating_moments(reward, {Vector::Zero(1), Matrix::Constant(1, 1, -2)}).mean));
  EXPECT_TRUE(std::isnan(saturating_moments(reward, {Vector::Constant(1, HUGE_VAL), Matrix::Zero(1, 1)}).mean));
}

}  // namespace
}  // namespace rehearse::moments
