#include "rehearse/policy/network.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "check_slopes.hpp"
#include "fixture.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/testing/check_policy.hpp"

namespace rehearse::policy {
namespace {

using fixture::features, fixture::inputs, fixture::kBounds, fixture::kScale, fixture::normals, fixture::task;

std::shared_ptr<const Policy> mlp(Index hidden, double gain = 1) {
  return make_mlp({.features = features(), .scale = kScale, .hidden = hidden, .squash = {kBounds, gain}});
}
std::shared_ptr<const Policy> linear(double gain = 1, Squash::Shape shape = Squash::Shape::tanh) {
  return make_linear({.features = features(), .scale = kScale, .squash = {kBounds, gain, shape}});
}

/// One layer, weight by weight from `theta`, which is advanced.
Vector layer(const double*& theta, const Vector& in, Index outputs) {
  Vector out(outputs);
  for (Index o = 0; o < outputs; ++o) {
    out(o) = 0;
    for (Index i = 0; i < in.size(); ++i) out(o) += *theta++ * in(i);
    out(o) += *theta++;
  }
  return out;
}

Vector squash(const Vector& a, double gain) {
  Vector u(a.size());
  for (Index i = 0; i < a.size(); ++i) {
    const Interval& b = kBounds[static_cast<std::size_t>(i)];
    u(i) = (b.low + b.high) / 2 + (b.high - b.low) / 2 * std::tanh(gain * a(i));
  }
  return u;
}

TEST(Mlp, IsItsFormula) {
  for (const Index hidden : {1, 3, 10}) {
    for (const Index rows : {1, 2, 7, 64}) {
      const auto policy = mlp(hidden, 5);
      ASSERT_EQ(policy->parameters(), hidden * 4 + 2 * (hidden + 1));
      const Matrix Theta = normals(rows, policy->parameters(), 1), X = 3 * normals(rows, 3, 2);
      Matrix U(rows, 2);
      policy->act(Theta, X, 0, U);
      for (Index r = 0; r < rows; ++r) {
        const Vector row = Theta.row(r);
        const double* theta = row.data();
        const Vector units = layer(theta, inputs(X, r), hidden).array().tanh();
        EXPECT_LT((U.row(r).transpose() - squash(layer(theta, units, 2), 5)).norm(), 1e-12);
      }
    }
  }
}

TEST(Linear, IsItsFormula) {
  const auto policy = linear(0.7);
  ASSERT_EQ(policy->parameters(), 8);
  const Matrix Theta = normals(13, 8, 1), X = 3 * normals(13, 3, 2);
  Matrix U(13, 2);
  policy->act(Theta, X, 0, U);
  for (Index r = 0; r < 13; ++r) {
    const Vector row = Theta.row(r);
    const double* theta = row.data();
    EXPECT_LT((U.row(r).transpose() - squash(layer(theta, inputs(X, r), 2), 0.7)).norm(), 1e-13);
  }
}

TEST(Linear, SaysWhatItIsMadeOf) {
  const auto policy = std::dynamic_pointer_cast<const Linear>(linear(3, Squash::Shape::sine));
  ASSERT_TRUE(policy);
  EXPECT_EQ(policy->options().squash.gain, 3);
  EXPECT_EQ(policy->options().squash.shape, Squash::Shape::sine);
}

TEST(Network, KeepsTheLawsOfPolicies) {
  for (const auto& policy : {mlp(10, 5), mlp(3), linear(), linear(100), linear(3, Squash::Shape::sine)})
    EXPECT_EQ(testing::check_policy(*policy, task()), std::vector<std::string>{}) << policy->name();
}

TEST(Network, BoundsHoldToTheBitForAwkwardIntervals) {
  Rng rng({.seed = 1});
  for (int i = 0; i < 2000; ++i) {
    const double low = rng.normal(), high = low + std::abs(rng.normal());
    const auto policy = make_linear(
        {.features = FeatureMap({StateKind::plain}), .scale = Vector::Ones(1), .squash = {{{low, high}}, 1}});
    Matrix U(2, 1);
    policy->act(Matrix{{0, 100}, {0, -100}}, Matrix::Zero(2, 1), 0, U);
    ASSERT_LE(U(0, 0), high);
    ASSERT_GE(U(1, 0), low);
  }
}

TEST(Network, SaysWhatIsWrong) {
  EXPECT_THROW(mlp(0), InvalidInput);
  EXPECT_THROW(make_linear({.features = features(), .scale = Vector::Ones(2), .squash = {kBounds, 1}}), InvalidInput);
  EXPECT_THROW(make_linear({.features = features(), .scale = Vector::Zero(3), .squash = {kBounds, 1}}), InvalidInput);
  EXPECT_THROW(make_linear({.features = features(), .scale = kScale, .squash = {}}), InvalidInput);
}

TEST(Mlp, KnowsItsDerivatives) {
  const auto policy = mlp(4, 1.5);
  check_slopes(*policy, normals(policy->parameters(), 1, 1), normals(9, 3, 2), normals(9, 2, 3));
  const auto weights = dynamic_cast<const Differentiable&>(*policy).unit_weights();
  EXPECT_EQ(weights, (std::vector<Index>{16, 17, 18, 19, 21, 22, 23, 24}));
}

TEST(Linear, KnowsItsDerivatives) {
  for (const auto shape : {Squash::Shape::tanh, Squash::Shape::sine}) {
    const auto policy = linear(0.7, shape);
    check_slopes(*policy, normals(policy->parameters(), 1, 1), normals(9, 3, 2), normals(9, 2, 3));
    EXPECT_TRUE(dynamic_cast<const Differentiable&>(*policy).unit_weights().empty());
  }
}

}  // namespace
}  // namespace rehearse::policy
