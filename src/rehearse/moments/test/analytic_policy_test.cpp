#include "rehearse/moments/analytic_policy.hpp"

#include <gtest/gtest.h>

#include "policies.hpp"

namespace rehearse::moments {
namespace {

using policies::kLinear, policies::kRbf;

TEST(AnalyticPolicy, MomentsAreThereForAnalyticPoliciesOnly) {
  EXPECT_TRUE(policy_moments(*policy::make_rbf(kRbf)));
  policy::LinearOptions with_tanh = kLinear;
  with_tanh.squash.shape = policy::Squash::Shape::tanh;
  EXPECT_FALSE(policy_moments(*policy::make_linear(with_tanh)));
  EXPECT_FALSE(analytic_options(*policy::make_linear(with_tanh)));
}

TEST(AnalyticPolicy, OptionsAreThoseOfThePolicy) {
  const auto rbf = policy::make_rbf(kRbf), linear = policy::make_linear(kLinear);
  const auto of_rbf = analytic_options(*rbf), of_linear = analytic_options(*linear);
  ASSERT_TRUE(of_rbf && std::holds_alternative<const policy::RbfOptions*>(*of_rbf));
  ASSERT_TRUE(of_linear && std::holds_alternative<const policy::LinearOptions*>(*of_linear));
  EXPECT_EQ(std::get<const policy::RbfOptions*>(*of_rbf)->centres, 8);
  EXPECT_EQ(std::get<const policy::LinearOptions*>(*of_linear)->squash.gain, 1.5);
}

}  // namespace
}  // namespace rehearse::moments
