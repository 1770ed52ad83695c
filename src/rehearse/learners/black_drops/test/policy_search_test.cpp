#include "rehearse/learners/black_drops/policy_search.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/simulator_model.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

SearchOptions small() {
  SearchOptions options;
  options.race.max_evaluations = 400;
  options.race.descents = 4;
  options.race.rounds = 2;
  options.race.judgements = 4;
  options.race.cmaes.population = 8;
  options.selection = 10;
  return options;
}

SearchResult search(const std::vector<Vector>& starts, const SearchOptions& options, std::uint64_t seed = 1,
                    std::uint64_t trial = 1, const Evaluator& evaluator = serial_evaluator(),
                    const ProgressSink& progress = {}) {
  const dynamics::SimulatorModel model(slider::prior(), slider::kTruth, 0.0004);
  const auto policy = slider::policy();
  const Task task = slider::task();
  return search_policy({model, *policy, task, evaluator, progress}, starts, options,
                       {.seed = seed, .trial = trial, .stage = Stage::search});
}

TEST(SearchPolicy, FindsAPolicyAsGoodAsPredicted) {
  const SearchResult found = search({}, small());
  EXPECT_GT(found.predicted_return, 7);
  EXPECT_NEAR(slider::run_trial({.policy = slider::policy(), .theta = found.theta}, 1).total_reward(),
              found.predicted_return, 1);
  EXPECT_LE(found.theta.cwiseAbs().maxCoeff(), small().box);
  EXPECT_GE(found.rollouts, 300);
  EXPECT_LE(found.rollouts, 400 + small().finalists * small().selection);
  EXPECT_EQ(found.failed_rollouts, 0);
  EXPECT_FALSE(found.runners_up.empty());
}

TEST(SearchPolicy, DependsOnSeedAndTrialAlone) {
  const auto threads = make_thread_evaluator(2);
  const SearchResult one = search({}, small()), two = search({}, small(), 1, 1, *threads);
  EXPECT_EQ(one.theta, two.theta);
  EXPECT_EQ(one.predicted_return, two.predicted_return);
  EXPECT_EQ(one.rollouts, two.rollouts);
  EXPECT_NE(one.theta, search({}, small(), 2).theta);
  EXPECT_NE(one.theta, search({}, small(), 1, 2).theta);
}

// A trial's searches and comparisons draw the same whatever comes first, and each its own.
TEST(SearchPolicy, OfAnotherStageOrNumberDrawsItsOwnNumbersInAnyOrder) {
  const dynamics::SimulatorModel model(slider::prior(), slider::kTruth, 0.0004);
  const auto policy = slider::policy();
  const Task task = slider::task();
  const SearchProblem problem{model, *policy, task, serial_evaluator(), {}};
  const std::vector<StreamKey> keys = {
      {.stage = Stage::search}, {.stage = Stage::search, .search = 1}, {.stage = Stage::solving_search}};
  const auto search = [&](const StreamKey& key) { return search_policy(problem, {}, small(), key).theta; };
  std::vector<Vector> forwards, backwards;
  for (const StreamKey& key : keys) forwards.push_back(search(key));
  for (auto key = keys.rbegin(); key != keys.rend(); ++key) backwards.insert(backwards.begin(), search(*key));
  EXPECT_EQ(forwards, backwards);
  EXPECT_NE(forwards[0], forwards[1]);
  EXPECT_NE(forwards[0], forwards[2]);
  const Vector theta{{-2, 0}};
  EXPECT_NE(judge(problem, theta, small(), {.stage = Stage::judging}).predicted_return,
            judge(problem, theta, small(), {.stage = Stage::search}).predicted_return);
}

TEST(SearchPolicy, AGoodStartIsNotLost) {
  SearchOptions tiny = small();
  tiny.race.max_evaluations = 64;
  const Vector good{{-5, 0}};
  EXPECT_GT(search({good}, tiny).predicted_return, 6.5);
}

TEST(SearchPolicy, SeveralParticlesAreOneEvaluation) {
  SearchOptions options = small();
  options.particles = 3;
  EXPECT_GE(search({}, options).rollouts, 3 * 300);
}

TEST(SearchPolicy, ReportsHowFarItIs) {
  double last = 0;
  Index rollouts = 0;
  search({}, small(), 1, 1, serial_evaluator(), [&](const Progress& progress) {
    EXPECT_EQ(progress.phase, "search");
    EXPECT_GE(progress.done, last);
    EXPECT_GE(progress.rollouts, rollouts);
    last = progress.done;
    rollouts = progress.rollouts;
  });
  EXPECT_GT(last, 0.5);
  EXPECT_LE(last, 1);
}

TEST(SolvingRates, CountSimulatedEpisodesThatSolve) {
  const dynamics::SimulatorModel uncertain(slider::prior(), slider::kTruth, 0.01),
      sure(slider::prior(), slider::kTruth);
  const auto policy = slider::policy();
  Task task = slider::task();
  task.start_std.setZero();
  const auto rates = [&](const dynamics::DynamicsModel& model, const Evaluator& evaluator, double beyond) {
    task.solved = [beyond](const Episode& e) { return e.true_states(e.steps(), 0) > beyond; };
    SearchOptions options = small();
    options.selection = 1000;
    const SolvingRates found = solving_rates({model, *policy, task, evaluator, {}}, {Vector{{-1, 0}}, Vector{{-5, 0}}},
                                             options, {.stage = Stage::solving});
    EXPECT_EQ(found.failed, 0);
    return found.rates;
  };
  const auto middle = [&](Index which) {
    const Vector theta = which == 0 ? Vector{{-1, 0}} : Vector{{-5, 0}};
    return rollout::simulate_recorded({sure, *policy, task, {}, {.sample = false}}, theta, 1).states.back()(0, 0);
  };
  const double beyond = middle(0);
  const Vector counted = rates(uncertain, serial_evaluator(), beyond);
  EXPECT_NEAR(counted(0), 0.5, 0.1) << "six deviations of 1000 fair coins";
  EXPECT_EQ(counted, rates(uncertain, *make_thread_evaluator(2), beyond));
  EXPECT_EQ(rates(sure, serial_evaluator(), beyond - 1e-6)(0), 1);
  EXPECT_EQ(rates(sure, serial_evaluator(), beyond + 1e-6)(0), 0);
  task.solved = nullptr;
  EXPECT_EQ(solving_rates({sure, *policy, task, serial_evaluator(), {}}, {Vector{{-1, 0}}}, small(), {}).rates,
            Vector::Zero(1));
}

TEST(SolvingRates, AskAModelWhoseCallsAreDearForAllPoliciesAtOnce) {
  prior::Prior prior = slider::prior();
  Index calls = 0;
  const auto counted = [&, cheap = prior.simulator](const ConstMatrixView& X, const ConstMatrixView& U,
                                                    const Vector& phi, MatrixView dX) {
    ++calls;
    cheap->change(X, U, phi, dX);
  };
  prior.simulator = system::make_simulator(prior.simulator->parameters(), counted, 1000);
  const dynamics::SimulatorModel dear(prior, slider::kTruth, 0.01), cheap(slider::prior(), slider::kTruth, 0.01);
  Task task = slider::task();
  const Vector middle =
      rollout::simulate_recorded({cheap, *slider::policy(), task, {}, {.sample = false}}, Vector{{-1, 0}}, 1)
          .states.back()
          .row(0);
  task.solved = [&](const Episode& e) { return e.true_states(e.steps(), 0) > middle(0); };
  const std::vector<Vector> policies = {Vector{{-1, 0}}, Vector{{-5, 0}}, Vector{{-0.1, 0.2}}, Vector{{0, 0}}};
  const auto rates = [&](const dynamics::DynamicsModel& model) {
    return solving_rates({model, *slider::policy(), task, serial_evaluator(), {}}, policies, small(), {}).rates;
  };
  const Vector expected = rates(cheap);
  EXPECT_TRUE(0 < expected(0) && expected(0) < 1) << expected(0);
  EXPECT_EQ(rates(dear), expected);
  EXPECT_EQ(calls, task.horizon);
}

// Before there are data a policy must solve the task for doubted priors, too.
TEST(SolvingRates, GoRoundTheDoubtedModels) {
  const auto near = [](const Vector& phi) {
    return std::make_shared<dynamics::SimulatorModel>(slider::prior(), phi, 1e-9);
  };
  const auto policy = slider::policy();
  Task task = slider::task();
  task.start_std.setZero();
  const Vector theta{{-1, 0}};
  const auto end = [&](const dynamics::DynamicsModel& model) {
    return rollout::simulate_recorded({model, *policy, task, {}, {.sample = false}}, theta, 1).states.back()(0, 0);
  };
  const auto truth = near(slider::kTruth), other = near(0.5 * slider::kTruth);
  const double between = (end(*truth) + end(*other)) / 2;
  ASSERT_NE(end(*truth), between);
  task.solved = [&](const Episode& e) { return (e.true_states(e.steps(), 0) > between) == (end(*truth) > between); };
  const auto rate = [&](std::vector<std::shared_ptr<const dynamics::DynamicsModel>> doubted) {
    return solving_rates({*truth, *policy, task, serial_evaluator(), {}, std::move(doubted)}, {theta}, small(), {})
        .rates(0);
  };
  EXPECT_EQ(rate({}), 1);
  EXPECT_EQ(rate({other, truth}), 0.5);
  EXPECT_EQ(rate({other}), 0);
}

TEST(RandomPolicy, IsUniformInTheBoxAndReproducible) {
  SearchOptions options;
  options.box = 2;
  const auto policy = slider::policy();
  double sum = 0, largest = 0;
  constexpr int kSeeds = 500;  // 1000 numbers; their mean is beyond 0.18 (5 deviations) with probability 6e-7
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Vector theta = random_policy(*policy, options, {.seed = seed});
    ASSERT_EQ(theta.size(), 2);
    EXPECT_EQ(theta, random_policy(*policy, options, {.seed = seed}));
    sum += theta.sum();
    largest = std::max(largest, theta.cwiseAbs().maxCoeff());
  }
  EXPECT_LT(std::abs(sum / (2 * kSeeds)), 0.19);
  EXPECT_LE(largest, 2);
  EXPECT_GT(largest, 1.9);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
