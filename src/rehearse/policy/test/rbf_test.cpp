#include "rehearse/policy/rbf.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "check_slopes.hpp"
#include "fixture.hpp"
#include "naive_rbf.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/testing/check_policy.hpp"

namespace rehearse::policy {
namespace {

using fixture::features, fixture::inputs, fixture::kBounds, fixture::kScale, fixture::normals, fixture::task;

constexpr double kNoise = 0.05;

std::shared_ptr<const Policy> rbf(Index centres, std::vector<Interval> bounds = kBounds) {
  return make_rbf(
      {.features = features(), .scale = kScale, .centres = centres, .noise = kNoise, .bounds = std::move(bounds)});
}

TEST(Rbf, IsItsFormula) {
  for (const Index centres : {1, 2, 10}) {
    for (const Index rows : {1, 3, 8, 17}) {
      const auto policy = rbf(centres);
      ASSERT_EQ(policy->parameters(), 2 * 3 + centres * 3 + 2 * centres);
      const Matrix Theta = normals(rows, policy->parameters(), 1), X = normals(rows, 3, 2);
      Matrix U(rows, 2);
      policy->act(Theta, X, 0, U);
      for (Index r = 0; r < rows; ++r) {
        const Vector x = inputs(X, r);
        for (Index a = 0; a < 2; ++a) {
          const double m = naive::mean(Theta.row(r), x, {3, centres, 2, kNoise}, a);
          const auto [low, high] = kBounds[static_cast<std::size_t>(a)];
          const double squashed = (9 * std::sin(m) + std::sin(3 * m)) / 8;
          EXPECT_NEAR(U(r, a), (low + high) / 2 + (high - low) / 2 * squashed, 1e-10);
        }
      }
    }
  }
}

// Rows in a row with one θ share its factorisation.
TEST(Rbf, ARowIsTheSameWhateverThetaTheOthersHave) {
  const auto policy = rbf(9);
  const Matrix X = 3 * normals(40, 3, 2);
  Matrix Theta = normals(40, policy->parameters(), 1), U(40, 2), alone(1, 2);
  for (Index r = 0; r < 40; ++r)
    if (r != 20) Theta.row(r) = Theta.row(r < 33 ? 0 : 39);
  for (int again = 0; again < 2; ++again) {
    policy->act(Theta, X, 0, U);
    for (Index r = 0; r < 40; ++r) {
      policy->act(Theta.row(r), X.row(r), 0, alone);
      EXPECT_EQ(U.row(r), alone) << r;
    }
  }
}

TEST(Rbf, SaysWhatItIsMadeOf) {
  const auto policy = std::dynamic_pointer_cast<const Rbf>(rbf(7));
  ASSERT_TRUE(policy);
  EXPECT_EQ(policy->options().centres, 7);
  EXPECT_EQ(make_rbf(policy->options())->parameters(), policy->parameters());
}

TEST(Rbf, PassesThroughItsTargetsWhereCentresAreFarApart) {
  const auto policy = make_rbf(
      {.features = FeatureMap({StateKind::plain}), .scale = Vector::Ones(1), .centres = 2, .bounds = {{-1, 1}}});
  const Matrix Theta{{0, -5, 5, 0.3, -0.7}};  // ln ℓ; centres; targets
  for (const double x : {-5.0, 0.0, 5.0}) {
    Matrix U(1, 1);
    policy->act(Theta, Matrix{{x}}, 0, U);
    const double m = x < 0 ? 0.3 : x > 0 ? -0.7 : 0;
    EXPECT_NEAR(U(0, 0), (9 * std::sin(m) + std::sin(3 * m)) / 8, 1e-3) << x;
  }
}

TEST(Rbf, KeepsTheLawsOfPolicies) {
  for (const Index centres : {1, 10, 50})
    EXPECT_EQ(testing::check_policy(*rbf(centres), task()), std::vector<std::string>{}) << centres;
}

TEST(Rbf, StaysInItsBoundsForHugeParameters) {
  const auto policy = rbf(10);
  for (const double size : {10.0, 1e3, 1e6}) {
    Matrix U(64, 2);
    policy->act(size * normals(64, policy->parameters(), 1), normals(64, 3, 2), 0, U);
    EXPECT_TRUE(U.allFinite()) << size;
  }
}

TEST(Rbf, SaysWhatIsWrong) {
  EXPECT_THROW(rbf(0), InvalidInput);
  EXPECT_THROW(rbf(10, {}), InvalidInput);
  EXPECT_THROW(make_rbf({.features = features(), .scale = Vector::Ones(2), .bounds = kBounds}), InvalidInput);
  EXPECT_THROW(make_rbf({.features = features(), .scale = Vector::Zero(3), .bounds = kBounds}), InvalidInput);
  EXPECT_THROW(make_rbf({.features = features(), .scale = kScale, .noise = 0, .bounds = kBounds}), InvalidInput);
}

TEST(Rbf, KnowsItsDerivatives) {
  const auto policy = rbf(6);
  check_slopes(*policy, 0.5 * normals(policy->parameters(), 1, 1), normals(9, 3, 2), normals(9, 2, 3));
}

}  // namespace
}  // namespace rehearse::policy
