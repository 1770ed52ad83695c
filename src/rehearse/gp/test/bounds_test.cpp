#include "rehearse/gp/bounds.hpp"

#include <gtest/gtest.h>

#include "naive.hpp"
#include "rehearse/testing/check_gradient.hpp"

namespace rehearse::gp {
namespace {

const Inputs kInputs(50 * naive::normals(20, 3, 1));
const SoftBounds kBounds({}, kInputs, 0.02);

Vector flat(double length, double signal, double noise) {
  Vector flat(5);
  flat << (length * kInputs.spread()).array().log().matrix(), std::log(0.02 * signal), std::log(0.02 * noise);
  return flat;
}

/// τ_0² and the others for inputs of their magnitude in units of the scale.
Vector with_trend(const Vector& flat, double trend) {
  Vector all(9);
  all << flat, 0.5 * std::log(0.02 * trend), 0.5 * std::log(0.02 * trend) - kInputs.magnitude().array().log();
  return all;
}

TEST(SoftBounds, IsTheIdentityFarFromThem) {
  const Vector plain = flat(2, 1.5, 0.1);
  for (const Vector& inside : {plain, with_trend(plain, 0.3)}) {
    EXPECT_LT((kBounds.flat(kBounds.free(inside)) - inside).norm(), 1e-12);
    EXPECT_EQ(kBounds.clamped(inside), inside);
    const Vector ones = Vector::Ones(inside.size());
    Vector gradient = ones;
    kBounds.to_free(kBounds.free(inside), gradient);
    EXPECT_LT((gradient - ones).norm(), 1e-3);
  }
}

TEST(SoftBounds, NothingLeavesThem) {
  for (const double u : {-1e4, -400.0, -20.0, 0.0, 20.0, 300.0}) {
    for (const Index size : {5, 9}) {
      const Vector reached = kBounds.flat(Vector::Constant(size, u));
      EXPECT_TRUE(reached.allFinite()) << u;
      EXPECT_LT((kBounds.clamped(reached) - reached).norm(), 1e-8) << u;
      Vector gradient = Vector::Ones(size);
      kBounds.to_free(Vector::Constant(size, u), gradient);
      EXPECT_TRUE(gradient.allFinite()) << u;
      EXPECT_GE(gradient.minCoeff(), 0) << u;
    }
  }
}

TEST(SoftBounds, GradientAgreesWithFiniteDifferences) {
  for (const double shift : {-16.0, -7.0, -1.0, 3.0, 9.0}) {
    for (const Index size : {5, 9}) {
      const Vector u = Vector::LinSpaced(size, shift, shift + 2), weights = Vector::LinSpaced(size, 1, 2);
      const auto weighted = [&](const Vector& at, Vector& gradient) {
        gradient = weights;
        kBounds.to_free(at, gradient);
        return weights.dot(kBounds.flat(at));
      };
      EXPECT_EQ(testing::check_gradient(weighted, u, 5e-8), std::vector<std::string>{}) << shift;
    }
  }
}

TEST(SoftBounds, StartsOutsideAreMovedInside) {
  const Vector low = flat(1e-9, 1e-9, 1e-9), high = flat(1e9, 1e9, 1e-9);
  for (const Vector& outside :
       {low, high, flat(1e300, 1, 0), with_trend(low, 0), with_trend(high, 1e9), with_trend(high, 1e-9)}) {
    const Vector clamped = kBounds.clamped(outside), reached = kBounds.flat(kBounds.free(outside));
    EXPECT_LT((reached - clamped).lpNorm<Eigen::Infinity>(), 0.02) << (reached - clamped).transpose();
  }
}

TEST(SoftBounds, AScaleOfZeroCountsAsOne) {
  const Vector u = Vector::Zero(5);
  for (const double scale : {0.0, -1.0, kNaN})
    EXPECT_EQ(SoftBounds({}, kInputs, scale).flat(u), SoftBounds({}, kInputs, 1).flat(u));
}

}  // namespace
}  // namespace rehearse::gp
