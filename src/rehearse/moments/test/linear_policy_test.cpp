#include "rehearse/moments/linear_policy.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/gaussian_tools.hpp"

namespace rehearse::moments {
namespace {

const policy::LinearOptions kOptions{.features = FeatureMap({StateKind::plain, StateKind::plain, StateKind::plain}),
                                     .scale = Vector{{1, 2, 0.5}},
                                     .squash = {{{-2, 2}, {0, 3}}, 1.5, policy::Squash::Shape::sine}};
const auto kPolicy = policy::make_linear(kOptions);

Vector theta() { return 0.7 * tools::normals(kPolicy->parameters(), 1, 1); }

Transformed moments(const Vector& at, const Gaussian& x) {
  const LinearPolicy policy(kOptions, at);
  PolicyTape tape;
  Transformed action;
  EXPECT_TRUE(policy.ok() && policy.forward(x, tape, action, serial_evaluator()));
  return action;
}

Vector act(const Vector& x) {
  Matrix U(1, 2);
  kPolicy->act(theta().transpose(), x.transpose(), 0, U);
  return U.row(0).transpose();
}

TEST(LinearPolicy, OfAKnownStateIsThePolicy) {
  const Gaussian x{tools::normals(3, 1, 2), Matrix::Zero(3, 3)};
  const Transformed action = moments(theta(), x);
  EXPECT_LT((action.mean - act(x.mean)).norm(), 1e-12);
  EXPECT_LT(action.covariance.norm(), 1e-12);
}

// What the squash sees is Gaussian, so that its moments are exact.
TEST(LinearPolicy, HasTheMomentsOfSamples) {
  const Gaussian x = tools::random_gaussian(3, 0.5, 4);
  tools::expect_samples([](const Vector& at, const Vector&) { return act(at); }, x, moments(theta(), x), 6);
}

TEST(LinearPolicy, AdjointAgreesWithDifferences) {
  const Gaussian x = tools::random_gaussian(3, 0.5, 4);
  const Transformed by = tools::random_adjoint(3, 2, 5);
  const LinearPolicy policy(kOptions, theta());
  PolicyTape tape;
  Transformed action;
  ASSERT_TRUE(policy.forward(x, tape, action, serial_evaluator()));
  Gaussian adjoint = Gaussian::zero(3);
  PolicyAdjoint of_policy = policy.zero_adjoints();
  policy.adjoint(x, tape, by, adjoint, of_policy);
  tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, moments(theta(), at)); }, x, adjoint, 1e-3,
                       1e-7);
  const Vector expected =
      tools::slopes([&](const Vector& at) { return tools::inner(by, moments(at, x)); }, theta(), 1e-4);
  EXPECT_LT((policy.gradient(of_policy) - expected).norm(), 1e-8 * expected.norm());
}

TEST(LinearPolicy, SaysWhatCannotBeComputed) {
  EXPECT_THROW(LinearPolicy(kOptions, Vector::Zero(5)), InvalidInput);
  policy::LinearOptions with_tanh = kOptions;
  with_tanh.squash.shape = policy::Squash::Shape::tanh;
  EXPECT_THROW(LinearPolicy(with_tanh, theta()), InvalidInput);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Vector at = theta();
    at(7) = bad;
    EXPECT_FALSE(LinearPolicy(kOptions, at).ok());
  }
}

}  // namespace
}  // namespace rehearse::moments
