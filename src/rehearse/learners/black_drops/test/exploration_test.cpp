#include "rehearse/learners/black_drops/exploration.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/policy/schedule.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

TEST(RandomActions, AreAFractionOfTheirWayFromTheMiddle) {
  Task task = slider::task();
  task.actions[0].bounds = {-1, 3};
  const Vector whole = random_actions(task, {}, {.seed = 2}), some = smaller_actions(task, whole, 0.25);
  EXPECT_EQ(whole, policy::random_schedule(task, policy::RandomActions::uniform, FirstTrial().hold_s, {.seed = 2}));
  EXPECT_LT((some.array() - 1 - 0.25 * (whole.array() - 1)).abs().maxCoeff(), 1e-15);
}

TEST(SafeRandomActions, AreAsLargeAsTheLimitsAllow) {
  Task task = slider::task();
  const auto largest = [&](double reach) -> std::optional<double> {
    const auto holds = [reach](const Steps& steps, VectorView kept) {
      kept = (steps.U.col(0).array().abs() <= reach).cast<double>();
    };
    task.limits = {{"pull", "", holds, 0.05}};
    const dynamics::SimulatorModel model(slider::prior(), slider::kTruth);
    const auto schedule = policy::make_schedule(task);
    const ProgressSink nobody;
    const auto found = safe_random_actions({model, *schedule, task, serial_evaluator(), nobody}, {}, {.seed = 2});
    EXPECT_EQ(found.rollouts % found.risks.front().episodes, 0);
    EXPECT_GE(found.rollouts, found.risks.front().episodes);
    if (found.excess > 0) return std::nullopt;
    EXPECT_EQ(found.risks.front().broken, 0);
    return found.theta.cwiseAbs().maxCoeff();
  };
  const double all = largest(1).value();
  EXPECT_GT(all, 0.5);
  const double half = largest(0.5 * all).value();
  EXPECT_LE(half, 0.5 * all);
  EXPECT_GT(half, 0.34 * all) << "0.7 of it would have been too much";
  EXPECT_GT(largest(0.01).value(), 0.003) << "however little it is";
  EXPECT_FALSE(largest(-1)) << "nothing is safe";
}

}  // namespace
}  // namespace rehearse::learners::black_drops
