#include "rehearse/moments/rbf_policy.hpp"

#include <gtest/gtest.h>

#include "policies.hpp"

namespace rehearse::moments {
namespace {

using policies::kRbfCase, policies::action_moments, policies::theta;

// Actions are in the middle of their bounds, where the squash has slope 3/2.
TEST(RbfPolicy, PilcosVarianceIsAddedBeforeTheSquash) {
  Vector at = theta(kRbfCase);
  at.tail(2 * 8).setZero();  // the targets
  const Gaussian x{Vector{{0.3, -0.2, 0.1}}, Matrix::Zero(3, 3)};
  const Vector slopes{{1.5 * 2, 1.5 * 1.5}};  // times half the widths of the bounds
  EXPECT_TRUE(action_moments(kRbfCase, at, x).covariance.diagonal().isApprox(1e-6 * slopes.cwiseAbs2(), 1e-4));
}

TEST(RbfPolicy, LengthScalesOutOfAllProportionStayFinite) {
  const Gaussian x = tools::random_gaussian(3, 0.5, 4);
  for (const double log_length : {-400.0, 400.0}) {
    Vector at = theta(kRbfCase);
    at.head(2 * 3).setConstant(log_length);
    const Transformed action = action_moments(kRbfCase, at, x);
    EXPECT_TRUE(action.mean.allFinite() && action.covariance.allFinite() && action.gain.allFinite()) << log_length;
    at.head(2 * 3).setConstant(log_length > 0 ? 20 : -20);
    EXPECT_EQ(action_moments(kRbfCase, at, x).mean, action.mean) << "clamped as the policy itself has it";
  }
}

}  // namespace
}  // namespace rehearse::moments
