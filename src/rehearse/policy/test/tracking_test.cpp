#include "rehearse/policy/tracking.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "fixture.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/policy/description.hpp"
#include "rehearse/testing/check_policy.hpp"

namespace rehearse::policy {
namespace {

/// Three stages of one action about the states v, angle and place.
std::vector<FeedbackStage> stages() {
  return {{Vector{{1, 0.2}}, Vector{{0, 0, 0}}, Matrix{{1, 0, 0}, {0, 0, 0}}},
          {Vector{{0, 0.2}}, Vector{{2, 3, 0}}, Matrix{{0, 1, 0}, {0, 0.01, 0}}},
          {Vector{{-1, 0.2}}, Vector{{0, 0, 5}}, Matrix{{0, 0, -1}, {0, 0, 1}}}};
}

Vector act(const Vector& theta, const Vector& state, double t_s) {
  const auto policy = make_tracking(fixture::task(), 3);
  Matrix U(1, 2);
  policy->act(theta.transpose(), state.transpose(), t_s, U);
  return U.row(0).transpose();
}

TEST(Tracking, IsFeedbackAboutEachStage) {
  const Vector theta = to_theta(stages());
  EXPECT_TRUE(act(theta, Vector{{0.5, 9, 9}}, 0).isApprox(Vector{{1.5, 0.2}}));
  EXPECT_TRUE(act(theta, Vector{{9, 3.5, 9}}, 0.1).isApprox(Vector{{0.5, 0.205}}));
  EXPECT_TRUE(act(theta, Vector{{9, 9, 6}}, 0.2).isApprox(Vector{{-2, 0.3}})) << "inside the bounds";
  EXPECT_EQ(act(theta, Vector{{9, 9, 6}}, 1e300), act(theta, Vector{{9, 9, 6}}, 0.2)) << "the last stage holds";
}

TEST(Tracking, IsBetweenTwoStagesBetweenTwoSteps) {
  const Vector theta = to_theta(stages()), state{{0.5, 3.5, 5.05}};
  const Vector before = act(theta, state, 0.1), after = act(theta, state, 0.2);
  EXPECT_TRUE(act(theta, state, 0.125).isApprox(0.75 * before + 0.25 * after));
  EXPECT_EQ(act(theta, state, 3 * 0.1 - 0.1), after) << "rounding of the time makes no difference";
}

TEST(Tracking, TakesTheShorterWayRound) {
  const Vector theta = to_theta(stages());
  const double turn = 2 * std::numbers::pi;
  EXPECT_NEAR(act(theta, Vector{{0, 3.5 - turn, 0}}, 0.1)(0), 0.5, 1e-12);
  EXPECT_NEAR(act(theta, Vector{{0, 2.5 + 3 * turn, 0}}, 0.1)(0), -0.5, 1e-12);
  EXPECT_NEAR(act(theta, Vector{{0, 0, 5 + turn}}, 0.2)(0), -3.5, 1e-12) << "a place is no angle";
}

TEST(Tracking, MayBeOpenLoop) {
  const Vector theta = to_theta(open_loop(fixture::task(), Matrix{{1, 0.2}, {-1, 0.3}}));
  EXPECT_EQ(act(theta, Vector{{7, 8, 9}}, 0), (Vector{{1, 0.2}}));
  EXPECT_EQ(act(theta, Vector{{7, 8, 9}}, 5), (Vector{{-1, 0.3}}));
}

TEST(Tracking, ThetaIsItsStages) {
  const Vector theta = to_theta(stages());
  ASSERT_EQ(theta.size(), 3 * numbers_of_stage(fixture::task()));
  EXPECT_EQ(to_theta(to_stages(fixture::task(), theta)), theta);
  EXPECT_EQ(to_stages(fixture::task(), theta)[1].gain, stages()[1].gain);
}

TEST(Tracking, SaysWhatItIs) {
  const Vector theta = to_theta(stages());
  const auto feedback = std::get<Feedback>(describe(*make_tracking(fixture::task(), 3), theta).form);
  EXPECT_EQ(feedback.actions.row(2), (Matrix{{-1, 0.2}}));
  EXPECT_EQ(feedback.states.row(1), (Matrix{{2, 3, 0}}));
  EXPECT_EQ(feedback.gains.row(1), (Matrix{{0, 1, 0, 0, 0.01, 0}}));
  EXPECT_EQ(feedback.angles, (std::vector<bool>{false, true, false}));
  EXPECT_EQ(feedback.per_s, 10);
}

TEST(Tracking, KeepsTheLawsOfPolicies) {
  const Task task = fixture::task();
  EXPECT_EQ(testing::check_policy(*make_tracking(task, task.horizon + 1), task), std::vector<std::string>{});
  EXPECT_THROW(make_tracking(task, 1), InvalidInput);
}

}  // namespace
}  // namespace rehearse::policy
