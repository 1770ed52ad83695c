#include "rehearse/moments/rbf_policy.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/gaussian_tools.hpp"

namespace rehearse::moments {
namespace {

const policy::RbfOptions kOptions{.features = FeatureMap({StateKind::plain, StateKind::plain, StateKind::plain}),
                                  .scale = Vector{{1, 2, 0.5}},
                                  .centres = 8,
                                  .bounds = {{-2, 2}, {0, 3}}};
const auto kPolicy = policy::make_rbf(kOptions);

Vector theta() { return tools::normals(kPolicy->parameters(), 1, 1); }

Transformed moments(const Vector& at, const Gaussian& x, double jitter = 1e-6) {
  const RbfPolicy policy(kOptions, at, jitter);
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

TEST(RbfPolicy, OfAKnownStateIsThePolicy) {
  const Gaussian x{tools::normals(3, 1, 2), Matrix::Zero(3, 3)};
  const Transformed action = moments(theta(), x, 0);
  EXPECT_LT((action.mean - act(x.mean)).norm(), 1e-9);
  EXPECT_LT(action.covariance.norm(), 1e-9);
}

/// The squash sees a Gaussian where the network's output is none: only of a state that is nearly known do the moments
/// have to be exact.
TEST(RbfPolicy, OfANearlyKnownStateHasTheSlopesOfThePolicy) {
  const Gaussian x{tools::normals(3, 1, 2), 1e-8 * tools::random_gaussian(3, 1, 3).covariance};
  const Transformed action = moments(theta(), x, 0);
  Matrix slopes(2, 3);
  for (Index d = 0; d < 3; ++d)
    slopes.col(d) = (act(x.mean + 1e-5 * Vector::Unit(3, d)) - act(x.mean - 1e-5 * Vector::Unit(3, d))) / 2e-5;
  EXPECT_LT((action.gain - slopes.transpose()).norm(), 1e-5 * slopes.norm());
  const Matrix covariance = slopes * x.covariance * slopes.transpose();
  EXPECT_LT((action.covariance - covariance).norm(), 1e-3 * covariance.norm());
}

TEST(RbfPolicy, AdjointAgreesWithDifferences) {
  const Gaussian x = tools::random_gaussian(3, 0.5, 4);
  const Transformed by = tools::random_adjoint(3, 2, 5);
  const RbfPolicy policy(kOptions, theta());
  PolicyTape tape;
  Transformed action;
  ASSERT_TRUE(policy.forward(x, tape, action, serial_evaluator()));
  Gaussian adjoint = Gaussian::zero(3);
  auto networks = policy.zero_adjoints();
  policy.adjoint(x, tape, by, adjoint, networks);
  tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, moments(theta(), at)); }, x, adjoint, 1e-3,
                       1e-6);
  const Vector gradient = policy.gradient(networks);
  const Vector expected =
      tools::slopes([&](const Vector& at) { return tools::inner(by, moments(at, x)); }, theta(), 1e-4);
  EXPECT_LT((gradient - expected).norm(), 1e-7 * expected.norm());
}

TEST(RbfPolicy, SaysWhatCannotBeComputed) {
  EXPECT_THROW(RbfPolicy(kOptions, Vector::Zero(5)), InvalidInput);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Vector at = theta();
    at(7) = bad;
    EXPECT_FALSE(RbfPolicy(kOptions, at).ok());
  }
  EXPECT_TRUE(RbfPolicy(kOptions, Vector::Zero(kPolicy->parameters())).ok()) << "all centres in one place";
}

}  // namespace
}  // namespace rehearse::moments
