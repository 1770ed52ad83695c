#include "rehearse/moments/policy_moments.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "policies.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::moments {
namespace {

using policies::act, policies::Case, policies::kLinearCase, policies::kRbfCase, policies::action_moments,
    policies::theta;

class PolicyMomentsTest : public ::testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(All, PolicyMomentsTest, ::testing::Values(kRbfCase, kLinearCase),
                         [](const auto& info) { return info.param.policy->name(); });

/// The variance of an action of a known state, before the squash: PILCO's policies have some.
double added_variance(const Case& c) { return c.policy->name() == "rbf" ? 1e-6 : 0; }

TEST_P(PolicyMomentsTest, OfAKnownStateAreThePolicy) {
  const Case& c = GetParam();
  const Gaussian x{tools::normals(3, 1, 2), Matrix::Zero(3, 3)};
  const Transformed action = action_moments(c, theta(c), x);
  EXPECT_LT((action.mean - act(c, x.mean)).norm(), 1e-9 + 10 * added_variance(c));
  EXPECT_LT(action.covariance.norm(), 1e-9 + 10 * added_variance(c));
}

/// The squash sees a Gaussian where the output of a network is none: only of a state that is nearly known do the
/// moments have to be exact.
TEST_P(PolicyMomentsTest, OfANearlyKnownStateHaveTheSlopesOfThePolicy) {
  const Case& c = GetParam();
  const Gaussian x{tools::normals(3, 1, 2), 1e-8 * tools::random_gaussian(3, 1, 3).covariance};
  const Transformed action = action_moments(c, theta(c), x);
  const Matrix added = action_moments(c, theta(c), {x.mean, Matrix::Zero(3, 3)}).covariance;
  Matrix slopes(2, 3);
  for (Index d = 0; d < 3; ++d)
    slopes.col(d) = (act(c, x.mean + 1e-5 * Vector::Unit(3, d)) - act(c, x.mean - 1e-5 * Vector::Unit(3, d))) / 2e-5;
  EXPECT_LT((action.gain - slopes.transpose()).norm(), 1e-5 * slopes.norm());
  const Matrix covariance = slopes * x.covariance * slopes.transpose();
  EXPECT_LT((action.covariance - added - covariance).norm(), 1e-3 * covariance.norm());
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
  tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, action_moments(c, theta(c), at)); }, x,
                       adjoint, 1e-3, 1e-6);
  const Vector gradient = policy->gradient(of_policy);
  const Vector expected =
      tools::slopes([&](const Vector& at) { return tools::inner(by, action_moments(c, at, x)); }, theta(c), 1e-4);
  EXPECT_LT((gradient - expected).norm(), 1e-7 * expected.norm());
}

TEST_P(PolicyMomentsTest, SayWhatCannotBeComputed) {
  const Case& c = GetParam();
  EXPECT_THROW(c.at(Vector::Zero(5)), InvalidInput);
  EXPECT_THROW(action_moments(c, theta(c), Gaussian::zero(4)), InvalidInput);
  EXPECT_THROW(action_moments(c, theta(c), {Vector::Zero(3), Matrix::Zero(2, 2)}), InvalidInput);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Vector at = theta(c);
    at(7) = bad;
    EXPECT_FALSE(c.at(at)->ok());
  }
  EXPECT_TRUE(c.at(Vector::Zero(c.policy->parameters()))->ok()) << "all centres in one place";
}

}  // namespace
}  // namespace rehearse::moments
