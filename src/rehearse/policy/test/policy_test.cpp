#include "rehearse/policy/policy.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/gait.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/policy/rbf.hpp"
#include "rehearse/policy/schedule.hpp"

namespace rehearse::policy {
namespace {

const FeatureMap kFeatures({StateKind::plain, StateKind::plain});
const std::vector<Interval> kUnitBounds = {{-1, 1}};

/// One of every kind, for two states where that matters.
std::vector<std::shared_ptr<const Policy>> policies() {
  const Vector scale = Vector::Ones(2);
  return {make_mlp({.features = kFeatures, .scale = scale, .hidden = 2, .squash = {kUnitBounds, 1}}),
          make_linear({.features = kFeatures, .scale = scale, .squash = {kUnitBounds, 1}}),
          make_rbf({.features = kFeatures, .scale = scale, .centres = 2, .bounds = kUnitBounds}),
          make_schedule(kUnitBounds, 0.1, 5), make_gait(6)};
}

TEST(Policy, WrongSizesAreRefusedByEveryKind) {
  for (const auto& policy : policies()) {
    const Index P = policy->parameters(), du = policy->actions();
    const Matrix Theta = Matrix::Constant(3, P, 0.5), X = Matrix::Zero(3, 2);
    Matrix U(3, du), few(2, du), wide(3, du + 1);
    policy->act(Theta, X, 0, U);
    EXPECT_TRUE(U.allFinite()) << policy->name();
    EXPECT_THROW(policy->act(Theta.leftCols(P - 1), X, 0, U), InvalidInput) << policy->name();
    EXPECT_THROW(policy->act(Theta.topRows(2), X, 0, U), InvalidInput) << policy->name();
    EXPECT_THROW(policy->act(Theta, X, 0, few), InvalidInput) << policy->name();
    EXPECT_THROW(policy->act(Theta, X, 0, wide), InvalidInput) << policy->name();
    if (policy->name() == "schedule" || policy->name() == "gait") continue;
    EXPECT_THROW(policy->act(Theta, X.leftCols(1), 0, U), InvalidInput) << policy->name();
  }
}

TEST(Policy, EverySizeThatIsWrongIsNamed) {
  const auto policy = policies().front();
  try {
    check_sizes(*policy, 2, Matrix(1, 2), Matrix(3, 4), Matrix(5, 6));
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.violations(),
              (std::vector<std::string>{"states are 3 × 4, must have 2 columns", "theta is 1 × 2, must be 3 × 9",
                                        "actions are 5 × 6, must be 3 × 1"}));
  }
}

}  // namespace
}  // namespace rehearse::policy
