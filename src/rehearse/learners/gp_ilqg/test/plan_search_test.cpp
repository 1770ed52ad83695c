#include "rehearse/learners/gp_ilqg/plan_search.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "rehearse/lqr/test/line.hpp"
#include "rehearse/policy/tracking.hpp"

namespace rehearse::learners::gp_ilqg {
namespace {

constexpr PlanSearch kSmall{.starts = 4, .first_iterations = 5, .finalists = 2, .iterations = 10, .selection = 20};

std::optional<FoundPlan> search(const Task& task, const PlanSearch& options, const Evaluator& evaluator,
                                const std::optional<Vector>& last = {}) {
  const lqr::line::Model model(1e-4);
  return search_plan({model, task, evaluator}, options, last, {.trial = 1}, {});
}

TEST(PlanSearch, FindsWhatPullsToZero) {
  const Task task = lqr::line::task(2);
  const auto found = search(task, kSmall, serial_evaluator());
  ASSERT_TRUE(found);
  EXPECT_GT(found->predicted_return, -12) << "pulling from the start as hard as it goes earns about −10, nothing −30";
  EXPECT_EQ(found->theta.size(), 31 * policy::numbers_of_stage(task));
  EXPECT_EQ(found->rollouts % kSmall.selection, 0);
}

TEST(PlanSearch, IsTheSameForAnyNumberOfThreads) {
  const Task task = lqr::line::task(2);
  const auto two = make_thread_evaluator(2);
  EXPECT_EQ(search(task, kSmall, serial_evaluator())->theta, search(task, kSmall, *two)->theta);
}

TEST(PlanSearch, BeginsWithTheLastPlan) {
  const Task task = lqr::line::task(2);
  PlanSearch none = kSmall;
  none.first_iterations = 1;
  none.iterations = 0;
  const auto good = search(task, kSmall, serial_evaluator());
  const auto again = search(task, none, serial_evaluator(), good->theta);
  EXPECT_NEAR(again->predicted_return, good->predicted_return, 0.2);
}

TEST(PlanSearch, TellsHowFarItIs) {
  const Task task = lqr::line::task(2);
  const lqr::line::Model model(1e-4);
  std::vector<double> done;
  const ProgressSink sink = [&](const Progress& progress) { done.push_back(progress.done); };
  search_plan({model, task, serial_evaluator()}, kSmall, {}, {.trial = 1}, sink);
  ASSERT_GT(done.size(), 4u) << "once at the start, and after each of the four first plans";
  EXPECT_EQ(done.front(), 0);
  EXPECT_TRUE(std::ranges::is_sorted(done));
  EXPECT_LE(done.back(), 1);
  EXPECT_GT(done.back(), 0.5);
}

TEST(PlanSearch, PlansForAsLongAsItIsTold) {
  const Task task = lqr::line::task(2);
  PlanSearch one_second = kSmall;
  one_second.plan_s = 1;
  EXPECT_EQ(steps_to_plan(task, kSmall), 30);
  EXPECT_EQ(steps_to_plan(task, one_second), 10);
  const auto found = search(task, one_second, serial_evaluator());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->theta.size(), 11 * policy::numbers_of_stage(task));
}

TEST(PlanSearch, PrefersWhatSolvesTheTask) {
  Task task = lqr::line::task(2);
  task.solved = [](const Episode& episode) { return episode.states(episode.steps(), 0) < 0.5; };
  EXPECT_TRUE(search(task, kSmall, serial_evaluator()));
}

/// The line, measured with noise.
class Shaky final : public dynamics::DynamicsModel {
 public:
  explicit Shaky(double noise) : std_(Vector::Constant(2, noise)) {}
  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
               MatrixView variance) const override {
    line_.predict(X, U, mean, variance);
  }
  const Vector& measurement_std() const override { return std_; }

 private:
  lqr::line::Model line_{1e-4};
  Vector std_;
};

double mean_gain(const Task& task, const FoundPlan& plan) {
  const auto stages = policy::to_stages(task, plan.theta);
  double sum = 0;
  for (const policy::FeedbackStage& stage : stages) sum += stage.gain.norm();
  return sum / static_cast<double>(stages.size());
}

TEST(PlanSearch, FeedbackIsSofterWhereMeasurementsAreNoisy) {
  const Task task = lqr::line::task(20);
  PlanSearch eager = kSmall;
  eager.action_cost = 1e-3;
  const auto found_with = [&](double noise) {
    const Shaky model(noise);
    return search_plan({model, task, serial_evaluator()}, eager, {}, {.trial = 1}, {});
  };
  const auto exact = found_with(1e-6), noisy = found_with(0.3);
  ASSERT_TRUE(exact && noisy);
  EXPECT_LT(mean_gain(task, *noisy), 0.9 * mean_gain(task, *exact));
  EXPECT_EQ(exact->theta, search(task, eager, serial_evaluator())->theta)
      << "noise that shakes nothing changes nothing";
}

TEST(PlanSearch, SaysWhenNoPlanIsFinite) {
  Task task = lqr::line::task(2);
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView rewards) {
    rewards.setConstant(kNaN);
  };
  EXPECT_FALSE(search(task, kSmall, serial_evaluator()));
}

}  // namespace
}  // namespace rehearse::learners::gp_ilqg
