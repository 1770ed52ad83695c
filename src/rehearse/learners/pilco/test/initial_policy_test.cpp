#include "rehearse/learners/pilco/initial_policy.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/learners/pilco/policy_search.hpp"
#include "slider.hpp"

namespace rehearse::learners::pilco {
namespace {

TEST(InitialPolicy, IsPilcosWhateverTheScale) {
  Task task = slider::task();
  task.states = {{"rate", ""}, {"angle", "", StateKind::angle}};
  task.start_mean = Vector{{3, 0}};
  task.start_std = Vector{{0.5, 0}};
  const SearchOptions options{.start_std = 0.2};
  EXPECT_EQ(start_state(task, options).covariance, (Matrix{{0.25, 0}, {0, 0.2 * 0.2}}));
  const auto theta = [&](const Vector& scale) {
    const auto policy =
        policy::make_rbf({.features = task.feature_map(), .scale = scale, .centres = 40, .bounds = {{-1, 1}}});
    return initial_policy(*policy, start_state(task, options), {.seed = 1, .trial = 2});
  };
  const Vector one = theta(Vector::Ones(3)), scaled = theta(Vector{{10, 1, 2}});
  EXPECT_TRUE(one.head(3).isApprox(Vector{{0, std::log(0.7), std::log(0.7)}}));
  EXPECT_TRUE(scaled.head(3).isApprox(Vector{{-std::log(10), std::log(0.7), std::log(0.35)}}));
  const auto centres = one.segment(3, 120).reshaped(3, 40);
  EXPECT_NEAR(centres.row(0).mean(), 3, 0.3);
  EXPECT_NEAR(centres.row(1).mean(), std::exp(-0.02), 0.02);
  EXPECT_TRUE(scaled.segment(3, 120).reshaped(3, 40).row(0).isApprox(centres.row(0) / 10));
  EXPECT_NEAR(std::sqrt(one.tail(40).squaredNorm() / 40), 0.1, 0.04);
}

TEST(InitialPolicy, ALinearOneHasTheSameActionsWhateverTheScaleAndTheGain) {
  const auto weights = [](const Vector& scale, double gain) -> Vector {
    const auto policy = policy::make_linear({.features = FeatureMap({StateKind::plain, StateKind::plain}),
                                             .scale = scale,
                                             .squash = {{{-1, 1}, {0, 2}}, gain, policy::Squash::Shape::sine}});
    const Vector theta = initial_policy(*policy, moments::Gaussian::zero(2), {.seed = 1, .trial = 2});
    Vector counted = theta.cwiseQuotient(units_of(*policy));
    EXPECT_TRUE(
        (gain * theta).isApprox((Matrix(3, 2) << scale, scale, 1, 1).finished().reshaped().cwiseProduct(counted)));
    return counted;
  };
  const Vector plain = weights(Vector::Ones(2), 1);
  EXPECT_TRUE(weights(Vector{{10, 0.5}}, 3).isApprox(plain));
  EXPECT_EQ(plain(2), 0);
  EXPECT_EQ(plain(5), 0);
  EXPECT_GT(plain.cwiseAbs().maxCoeff(), 0);
  EXPECT_LT(plain.cwiseAbs().maxCoeff(), 0.05);
}

}  // namespace
}  // namespace rehearse::learners::pilco
