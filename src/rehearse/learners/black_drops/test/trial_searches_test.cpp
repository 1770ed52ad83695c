#include "rehearse/learners/black_drops/trial_searches.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/simulator_model.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

/// The searches of a trial on the slider itself, with a little uncertainty.
struct TrialSearchesTest : ::testing::Test {
  TrialSearchesTest() {
    options.race.max_evaluations = 60;
    options.race.descents = 2;
    options.race.cmaes.population = 6;
    options.finalists = 2;
    options.selection = 5;
  }
  TrialSearches searches() const { return {problem, options, {.seed = 1, .trial = 2}}; }
  const dynamics::SimulatorModel model{slider::prior(), slider::kTruth, 0.0004};
  const std::shared_ptr<const policy::Policy> policy = slider::policy();
  Task task = slider::task();
  const ProgressSink nobody;
  const SearchProblem problem{model, *policy, task, serial_evaluator(), nobody};
  SearchOptions options;
};

TEST_F(TrialSearchesTest, EachHasItsOwnNumbersWhateverCameBefore) {
  task.solved = [](const Episode&) { return true; };
  TrialSearches one = searches(), other = searches();
  const SearchResult first = one.search({}, 0), second = one.search({}, 1);
  EXPECT_NE(first.theta, second.theta);
  EXPECT_EQ(other.search({}, 1).theta, second.theta);
  EXPECT_EQ(one.judge(first.theta).predicted_return, other.judge(first.theta).predicted_return);
  EXPECT_EQ(one.search_solving({}, 1, 0).theta, other.search_solving({}, 1, 0).theta);
}

TEST_F(TrialSearchesTest, PoliciesThatSolveTheTaskAreSearchedFor) {
  task.solved = [](const Episode& e) { return e.true_states(e.steps(), 0) > 0.3; };
  options.race.max_evaluations = 3000;
  TrialSearches trial = searches();
  const SearchResult highest = trial.search({}, 0), solving = trial.search_solving({}, 50, 0);
  const Vector often = trial.compare_solving({highest.theta, solving.theta});
  EXPECT_LT(often(0), 0.5) << "the highest return is that of a slider at 0";
  EXPECT_GT(often(1), 0.9);
  EXPECT_LT(solving.predicted_return, highest.predicted_return) << "without the bonus";
}

TEST_F(TrialSearchesTest, AllRolloutsAreCounted) {
  task.solved = [](const Episode&) { return true; };
  TrialSearches trial = searches();
  Index rollouts = trial.search({}, 0).rollouts;
  EXPECT_EQ(trial.rollouts(), rollouts);
  rollouts += trial.search_solving({}, 1, 0).rollouts;
  rollouts += trial.judge(Vector{{-5, 0}}).rollouts;
  EXPECT_EQ(trial.rollouts(), rollouts);
  EXPECT_EQ(trial.failed_rollouts(), 0);
}

TEST_F(TrialSearchesTest, FailuresAreCountedWhereverTheyHappen) {
  const dynamics::SimulatorModel broken({"broken",
                                         system::make_ode_simulator([](const Vector&, const Vector&, const Vector&,
                                                                       Vector& dxdt) { dxdt.setConstant(kNaN); },
                                                                    slider::prior().space, task.dt_s, 1),
                                         slider::prior().space},
                                        slider::kTruth);
  task.solved = [](const Episode&) { return true; };
  TrialSearches trial({broken, *policy, task, serial_evaluator(), nobody}, options, {.seed = 1, .trial = 2});
  EXPECT_FALSE(trial.best_that_solves({.theta = Vector::Zero(2)}));
  EXPECT_GT(trial.rollouts(), 0);
  EXPECT_EQ(trial.failed_rollouts(), trial.rollouts());
}

TEST_F(TrialSearchesTest, AModelIsSureWhereItsUncertaintyHardlyChangesTheReturn) {
  const Vector theta{{-3, 0}};
  EXPECT_FALSE(searches().is_sure_of(theta));
  const dynamics::SimulatorModel sure{slider::prior(), slider::kTruth, 1e-12};
  EXPECT_TRUE(TrialSearches({sure, *policy, task, serial_evaluator(), nobody}, options, {.seed = 1}).is_sure_of(theta));
}

// The reported return and risks of a choice come from episodes that did not choose it.
TEST_F(TrialSearchesTest, AChoiceIsJudgedAnewInOtherEpisodes) {
  TrialSearches trial = searches();
  const Vector theta{{-3, 0}};
  EXPECT_NE(trial.judge(theta).predicted_return, trial.judge_anew(theta).predicted_return);
  EXPECT_EQ(trial.judge_anew(theta).solving, 0);
  task.solved = [](const Episode&) { return true; };
  task.limits = {{"end", "", [](const Steps&, VectorView kept) { kept.setOnes(); }}};
  EXPECT_GT(searches().judge_anew(theta).solving, 1) << "in all episodes, and in the mean predictions";
}

TEST_F(TrialSearchesTest, OfThePoliciesFoundTheOneThatSolvesMostOftenIsTaken) {
  const Vector still = Vector::Zero(2), pull{{-5, 0}};
  const SearchResult found{.theta = still, .runners_up = {pull}};
  EXPECT_FALSE(searches().best_that_solves(found)) << "the task cannot say";
  task.solved = [](const Episode& e) { return std::abs(e.true_states(e.steps(), 0)) < 0.2; };
  TrialSearches trial = searches();
  const auto best = trial.best_that_solves(found);
  ASSERT_TRUE(best);
  EXPECT_EQ(best->theta, pull);
  EXPECT_GT(best->solving, 0.5);
  EXPECT_GT(trial.rollouts(), 2 * options.selection);
  task.solved = [](const Episode&) { return false; };
  EXPECT_FALSE(searches().best_that_solves(found));
}

TEST_F(TrialSearchesTest, ASafeSearchEvaluatesPoliciesByEightRollouts) {
  task.limits = {{"end", "", [](const Steps&, VectorView kept) { kept.setOnes(); }}};
  options.safety.rollouts = 80;
  TrialSearches trial = searches();
  const Index rollouts = trial.search_safe({Vector{{-5, 0}}, Vector{{-1, 0}}}, 0).rollouts;
  EXPECT_EQ(rollouts % 8, 0);
  EXPECT_GT(rollouts, trial.search({}, 0).rollouts / 2);
  EXPECT_EQ(trial.judge(Vector{{-5, 0}}).risks.front().episodes, 80);
}

TEST_F(TrialSearchesTest, ASafeSearchHasEvaluationsForItsFinalSamples) {
  task.limits = {{"end", "", [](const Steps&, VectorView kept) { kept.setOnes(); }}};
  options.method = Method::restarts;
  options.restarts.max_evaluations = 60;
  options.restarts.candidates = 2;
  options.restarts.final_samples = 10;
  EXPECT_NO_THROW(searches().search_safe({Vector{{-5, 0}}}, 0));
}

TEST_F(TrialSearchesTest, OfThoseThatSolveTheSafeOneIsTaken) {
  task.limits = {{"end", "position > 0.02", [](const Steps& steps, VectorView kept) {
                    kept = (steps.X_next.col(0).array() > 0.02).cast<double>();
                  }}};
  task.solved = [](const Episode& e) { return e.true_states(e.steps(), 0) < 0.6; };
  const Vector to_zero{{-5, 0}}, near{{-0.6, 0}};
  options.simulate.sample = false;
  const SearchResult found{.theta = to_zero, .runners_up = {near}};
  const auto safe = searches().best_that_solves(found);
  ASSERT_TRUE(safe);
  EXPECT_EQ(safe->theta, near);
  EXPECT_EQ(safe->excess, 0);
}

TEST(Within, IsAFractionOfWhatWasExpectedWhateverItsSign) {
  EXPECT_TRUE(within(0.1, 10, 9));
  EXPECT_FALSE(within(0.1, 10, 8.9));
  EXPECT_TRUE(within(0.1, -10, -11));
  EXPECT_FALSE(within(0.1, -10, -11.1));
}

}  // namespace
}  // namespace rehearse::learners::black_drops
