#include "rehearse/policy/schedule.hpp"

#include <gtest/gtest.h>

#include "fixture.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/testing/check_policy.hpp"

namespace rehearse::policy {
namespace {

TEST(Schedule, ActsByTheClock) {
  const auto policy = make_schedule({{-1, 1}, {0, 5}}, 0.1, 3);
  ASSERT_EQ(policy->parameters(), 6);
  const Matrix Theta{{0.1, 0.2, 7, 1, 2, -3}, {-0.1, -0.2, -0.3, 4, 5, 6}}, X = Matrix::Random(2, 1);
  Matrix U(2, 2);
  const auto at = [&](double t_s) {
    policy->act(Theta, X, t_s, U);
    return U;
  };
  EXPECT_EQ(at(0), (Matrix{{0.1, 1}, {-0.1, 4}}));
  EXPECT_EQ(at(0.1), (Matrix{{0.2, 2}, {-0.2, 5}}));
  EXPECT_EQ(at(3 * 0.1 - 0.1), (Matrix{{1, 0}, {-0.3, 5}})) << "inside the bounds";
  EXPECT_EQ(at(9), at(0.2)) << "the last action is held";
}

TEST(Schedule, KeepsTheLawsOfPolicies) {
  const Task task = fixture::task();
  const auto policy = make_schedule(fixture::kBounds, task.dt_s, task.horizon);
  EXPECT_EQ(testing::check_policy(*policy, task), std::vector<std::string>{});
}

TEST(RandomSchedule, OfExtremesHasBothBoundsAndNothingElse) {
  Task task = fixture::task();
  task.horizon = 50;  // that a bound does not come has a probability of 2⁻⁴⁸
  const Vector theta = random_schedule(task, RandomActions::extremes, 0, {.trial = 1});
  for (Index a = 0; a < 2; ++a) {
    const auto& [low, high] = task.actions[static_cast<std::size_t>(a)].bounds;
    const auto actions = theta.segment(a * task.horizon, task.horizon).array();
    EXPECT_GT((actions == low).count(), 0);
    EXPECT_EQ((actions == low).count() + (actions == high).count(), task.horizon);
    EXPECT_LT((actions == low).count(), task.horizon);
  }
}

TEST(RandomSchedule, HoldsEachActionForItsTime) {
  Task task = fixture::task();
  task.actions = {{"pull", "N", {-1, 1}}, {"push", "N", {2, 3}}};
  task.dt_s = 0.2;
  task.horizon = 12;
  for (const auto& [hold_s, steps] : std::vector<std::pair<double, Index>>{{0, 1}, {0.2, 1}, {0.44, 2}, {2, 2}}) {
    const Vector theta = random_schedule(task, RandomActions::uniform, hold_s, {.trial = 1});
    ASSERT_EQ(theta.size(), 2 * task.horizon);
    EXPECT_EQ(theta, random_schedule(task, RandomActions::uniform, hold_s, {.trial = 1}));
    EXPECT_NE(theta, random_schedule(task, RandomActions::uniform, hold_s, {.seed = 2, .trial = 1}));
    for (Index i = 0; i < theta.size(); ++i) {
      const Index t = i % task.horizon;
      EXPECT_EQ(t % steps > 0, t > 0 && theta(i) == theta(i - 1)) << i;
      const Interval& bounds = task.actions[static_cast<std::size_t>(i / task.horizon)].bounds;
      EXPECT_TRUE(bounds.low <= theta(i) && theta(i) <= bounds.high) << i;
    }
  }
}

TEST(Schedule, SaysWhatIsWrong) {
  EXPECT_THROW(make_schedule({}, 0.1, 3), InvalidInput);
  EXPECT_THROW(make_schedule({{0, 1}}, 0, 3), InvalidInput);
  EXPECT_THROW(make_schedule({{0, 1}}, 0.1, 0), InvalidInput);
}

}  // namespace
}  // namespace rehearse::policy
