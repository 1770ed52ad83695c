#include "rehearse/moments/linear_policy.hpp"

#include <gtest/gtest.h>

#include "policies.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::moments {
namespace {

using policies::act, policies::action_moments, policies::Case, policies::kLinear, policies::kLinearCase,
    policies::theta;

// The input of the squash is Gaussian, so that its moments are exact.
TEST(LinearPolicy, HasTheMomentsOfSamples) {
  const Case& c = kLinearCase;
  const Gaussian x = tools::random_gaussian(3, 0.5, 4);
  tools::expect_samples([&](const Vector& at, const Vector&) { return act(c, at); }, x, action_moments(c, theta(c), x),
                        6);
}

TEST(LinearPolicy, HasASquashWhoseMomentsAreKnown) {
  policy::LinearOptions with_tanh = kLinear;
  with_tanh.squash.shape = policy::Squash::Shape::tanh;
  EXPECT_THROW(LinearPolicy(with_tanh, Vector::Zero(8)), InvalidInput);
  EXPECT_NO_THROW(LinearPolicy(kLinear, Vector::Zero(8)));
}

TEST(LinearPolicy, HasAsManyAdjointsAsWeightsAndOffsets) {
  const PolicyAdjoint zero = LinearPolicy(kLinear, Vector::Zero(8)).zero_adjoints();
  EXPECT_EQ(zero.slopes, Matrix::Zero(2, 3));
  EXPECT_EQ(zero.offsets, Vector::Zero(2));
  EXPECT_TRUE(zero.networks.empty());
}

}  // namespace
}  // namespace rehearse::moments
