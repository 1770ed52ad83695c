#include "rehearse/moments/network_prior.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::moments {
namespace {

TEST(Network, IsTheSumOfItsTermsAtTheFeaturesAndActions) {
  const MomentTerm first{.output = 0,
                         .centres = Matrix{{1, 0, 0, 0.5}, {0, 1, -1, 0}},
                         .log_lengths = Vector{{0, 0.5, -0.5, 1}},
                         .weights = Vector{{2, -3}}};
  MomentTerm second = first;
  second.output = 1, second.weights *= 2;
  const FeatureMap features({StateKind::angle, StateKind::plain});
  const prior::Prior prior = network_prior("learned", features, {first, first, second});
  EXPECT_EQ(prior.name, "learned");
  EXPECT_EQ(prior.space.size(), 0);

  const Matrix X{{0.4, -0.2}, {2, 1}, {0.1, 0.1}}, U{{0.3}, {-1}, {0}};
  Matrix dX(3, 2), alone(1, 2);
  ASSERT_EQ(prior.mean(X, U, {}, dX), 0);
  for (Index i = 0; i < 3; ++i) {
    const Vector z{{std::cos(X(i, 0)), std::sin(X(i, 0)), X(i, 1), U(i, 0)}};
    double sum = 0;
    for (Index c = 0; c < 2; ++c)
      sum +=
          first.weights(c) *
          std::exp(-0.5 *
                   ((z - first.centres.row(c).transpose()).array() / first.log_lengths.array().exp()).square().sum());
    EXPECT_NEAR(dX(i, 0), 2 * sum, 1e-13);
    EXPECT_NEAR(dX(i, 1), 2 * sum, 1e-13);
    prior.mean(X.middleRows(i, 1), U.middleRows(i, 1), {}, alone);
    EXPECT_EQ(alone, dX.row(i)) << "a row depends on that row alone";
  }
}

}  // namespace
}  // namespace rehearse::moments
