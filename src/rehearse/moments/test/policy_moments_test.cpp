#include "rehearse/moments/policy_moments.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/moments/analytic_policy.hpp"
#include "rehearse/moments/linear_policy.hpp"
#include "rehearse/moments/rbf_policy.hpp"
#include "rehearse/moments/test/gaussian_tools.hpp"

namespace rehearse::moments {
namespace {

const FeatureMap kFeatures({StateKind::plain, StateKind::plain, StateKind::plain});
const Vector kScale{{1, 2, 0.5}};
const std::vector<Interval> kBounds{{-2, 2}, {0, 3}};
const policy::RbfOptions kRbf{.features = kFeatures, .scale = kScale, .centres = 8, .bounds = kBounds};
const policy::LinearOptions kLinear{
    .features = kFeatures, .scale = kScale, .squash = {kBounds, 1.5, policy::Squash::Shape::sine}};

/// A policy and its moments at a θ, without what PILCO adds to them.
struct Case {
  std::shared_ptr<const policy::Policy> policy;
  PolicyMomentsAt at;
};
const Case kRbfCase{policy::make_rbf(kRbf),
                    [](const ConstVectorView& theta) { return std::make_unique<RbfPolicy>(kRbf, theta, 0); }};
const Case kLinearCase{policy::make_linear(kLinear), policy_moments(*policy::make_linear(kLinear))};

Vector theta(const Case& c) { return tools::normals(c.policy->parameters(), 1, 1); }

Transformed moments(const Case& c, const Vector& theta, const Gaussian& x) {
  const auto policy = c.at(theta);
  PolicyTape tape;
  Transformed action;
  EXPECT_TRUE(policy->ok() && policy->forward(x, tape, action, serial_evaluator()));
  return action;
}

Vector act(const Case& c, const Vector& x) {
  Matrix U(1, 2);
  c.policy->act(theta(c).transpose(), x.transpose(), 0, U);
  return U.row(0).transpose();
}

class PolicyMomentsTest : public ::testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(All, PolicyMomentsTest, ::testing::Values(kRbfCase, kLinearCase),
                         [](const auto& info) { return info.param.policy->name(); });

TEST_P(PolicyMomentsTest, OfAKnownStateAreThePolicy) {
  const Case& c = GetParam();
  const Gaussian x{tools::normals(3, 1, 2), Matrix::Zero(3, 3)};
  const Transformed action = moments(c, theta(c), x);
  EXPECT_LT((action.mean - act(c, x.mean)).norm(), 1e-9);
  EXPECT_LT(action.covariance.norm(), 1e-9);
}

/// The squash sees a Gaussian where the output of a network is none: only of a state that is nearly known do the
/// moments have to be exact.
TEST_P(PolicyMomentsTest, OfANearlyKnownStateHaveTheSlopesOfThePolicy) {
  const Case& c = GetParam();
  const Gaussian x{tools::normals(3, 1, 2), 1e-8 * tools::random_gaussian(3, 1, 3).covariance};
  const Transformed action = moments(c, theta(c), x);
  Matrix slopes(2, 3);
  for (Index d = 0; d < 3; ++d)
    slopes.col(d) = (act(c, x.mean + 1e-5 * Vector::Unit(3, d)) - act(c, x.mean - 1e-5 * Vector::Unit(3, d))) / 2e-5;
  EXPECT_LT((action.gain - slopes.transpose()).norm(), 1e-5 * slopes.norm());
  const Matrix covariance = slopes * x.covariance * slopes.transpose();
  EXPECT_LT((action.covariance - covariance).norm(), 1e-3 * covariance.norm());
}

TEST_P(PolicyMomentsTest, AdjointAgreesWithDifferences) {
  const Case& c = GetParam();
  const Gaussian x = tools::random_gaussian(3, 0.5, 4);
  const Transformed by = tools::random_adjoint(3, 2, 5);
  const auto policy = c.at(theta(c));
  PolicyTape tape;
  Transformed action;
  ASSERT_TRUE(policy->forward(x, tape, action, serial_evaluator()));
  Gaussian adjoint = Gaussian::zero(3);
  PolicyAdjoint of_policy = policy->zero_adjoints();
  policy->adjoint(x, tape, by, adjoint, of_policy);
  tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, moments(c, theta(c), at)); }, x, adjoint, 1e-3,
                       1e-6);
  const Vector gradient = policy->gradient(of_policy);
  const Vector expected =
      tools::slopes([&](const Vector& at) { return tools::inner(by, moments(c, at, x)); }, theta(c), 1e-4);
  EXPECT_LT((gradient - expected).norm(), 1e-7 * expected.norm());
}

TEST_P(PolicyMomentsTest, SayWhatCannotBeComputed) {
  const Case& c = GetParam();
  EXPECT_THROW(c.at(Vector::Zero(5)), InvalidInput);
  EXPECT_THROW(moments(c, theta(c), Gaussian::zero(4)), InvalidInput);
  EXPECT_THROW(moments(c, theta(c), {Vector::Zero(3), Matrix::Zero(2, 2)}), InvalidInput);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Vector at = theta(c);
    at(7) = bad;
    EXPECT_FALSE(c.at(at)->ok());
  }
  EXPECT_TRUE(c.at(Vector::Zero(c.policy->parameters()))->ok()) << "all centres in one place";
}

// What the squash sees is Gaussian, so that its moments are exact.
TEST(LinearPolicy, HasTheMomentsOfSamples) {
  const Case& c = kLinearCase;
  const Gaussian x = tools::random_gaussian(3, 0.5, 4);
  tools::expect_samples([&](const Vector& at, const Vector&) { return act(c, at); }, x, moments(c, theta(c), x), 6);
}

TEST(PolicyMoments, AreThereForAnalyticPoliciesOnly) {
  EXPECT_TRUE(policy_moments(*policy::make_rbf(kRbf)));
  policy::LinearOptions with_tanh = kLinear;
  with_tanh.squash.shape = policy::Squash::Shape::tanh;
  EXPECT_FALSE(policy_moments(*policy::make_linear(with_tanh)));
  EXPECT_THROW(LinearPolicy(with_tanh, Vector::Zero(8)), InvalidInput);
}

}  // namespace
}  // namespace rehearse::moments
