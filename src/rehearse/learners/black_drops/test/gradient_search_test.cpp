#include "rehearse/learners/black_drops/gradient_search.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/learners/black_drops/policy_search.hpp"
#include "rehearse/policy/schedule.hpp"
#include "rehearse/testing/check_learner.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

constexpr Interval kBox{-5, 5};

GradientOptions few_steps() {
  GradientOptions options;
  options.steps = 120;
  options.particles = 8;
  options.descents = 4;
  options.rounds = 2;
  options.adam.step = 0.1;
  return options;
}

struct Found {
  std::vector<Vector> policies;
  Index rollouts = 0;
};

Found find(const GradientOptions& options, const std::vector<Vector>& starts = {}, std::uint64_t seed = 1,
           const Evaluator& evaluator = serial_evaluator(), const optim::SearchListener& listener = {}) {
  const dynamics::SimulatorModel model(slider::prior(), slider::kTruth, 0.0004);
  const auto policy = slider::policy();
  const Task task = slider::task();
  const ProgressSink silent;
  const SearchProblem problem{model, *policy, task, evaluator, silent};
  const StreamKey key{.seed = seed, .trial = 1, .stage = Stage::search, .purpose = Purpose::search};
  const SearchOptions search;
  SimulatedReturn objective(problem, search, key);
  Found found{search_by_gradient(objective, *policy, {kBox, starts}, options, key, listener)};
  found.rollouts = objective.rollouts();
  return found;
}

double value(const Vector& theta) {
  return slider::run_trial({.policy = slider::policy(), .theta = theta}, 1).total_reward();
}

TEST(GradientSearch, GivesNoneUpInARoundWithoutAStep) {
  GradientOptions once = few_steps(), in_rounds = few_steps();
  once.steps = in_rounds.steps = once.rounds = 1;
  in_rounds.rounds = 4;
  EXPECT_EQ(find(once).policies, find(in_rounds).policies);
}

TEST(GradientSearch, ClimbsFromRandomPoints) {
  const Found found = find(few_steps());
  ASSERT_EQ(found.policies.size(), 4U) << "those that were given up, too";
  EXPECT_GT(value(found.policies.front()), 6.5);
  EXPECT_EQ(found.rollouts, 120 * 8);
  for (const Vector& theta : found.policies) EXPECT_LE(theta.cwiseAbs().maxCoeff(), 5);
}

TEST(GradientSearch, StartsWhereItIsTold) {
  GradientOptions one = few_steps();
  one.descents = 1;
  one.steps = 1;
  one.rounds = 1;
  const Vector start{{1, -0.5}};
  EXPECT_NEAR((find(one, {start}).policies.front() - start).cwiseAbs().maxCoeff(), 0.1, 0.01) << "a step from there";
}

TEST(GradientSearch, DependsOnItsKeyAlone) {
  GradientOptions options = few_steps();
  options.steps = 20;
  const auto threads = make_thread_evaluator(2);
  const auto one = find(options).policies;
  EXPECT_EQ(one, find(options, {}, 1, *threads).policies);
  EXPECT_NE(one, find(options, {}, 2).policies);
}

TEST(GradientSearch, TellsHowFarItIs) {
  Index last = 0;
  find(few_steps(), {}, 1, serial_evaluator(), [&](Index rollouts, double) {
    EXPECT_GT(rollouts, last);
    last = rollouts;
  });
  EXPECT_EQ(last, 120 * 8);
}

/// A network, whose units dropout leaves out.
std::shared_ptr<const policy::Policy> network() {
  return policy::make_mlp(
      {.features = FeatureMap({StateKind::plain}), .scale = Vector::Ones(1), .hidden = 10, .squash = {{{-1, 1}}, 1}});
}

TEST(GradientSearch, DropoutLeavesWeightsOfUnitsOut) {
  const dynamics::SimulatorModel model(slider::prior(), slider::kTruth, 0.0004);
  const auto policy = network();
  const Task task = slider::task();
  const ProgressSink silent;
  const SearchProblem problem{model, *policy, task, serial_evaluator(), silent};
  const StreamKey key{.stage = Stage::search, .purpose = Purpose::search};
  const SearchOptions search;
  const auto first_step = [&](double dropout) {
    GradientOptions options{.steps = 1, .particles = 4, .descents = 1, .rounds = 1, .dropout = dropout};
    SimulatedReturn objective(problem, search, key);
    const std::vector<Vector> starts = {Vector::Constant(policy->parameters(), 0.1)};
    return Vector(search_by_gradient(objective, *policy, {kBox, starts}, options, key).front() - starts.front());
  };
  EXPECT_EQ((first_step(0).array() == 0).count(), 0);
  const Vector with = first_step(0.5);
  const Index unmoved = (with.segment(20, 10).array() == 0).count();
  EXPECT_GT(unmoved, 0);
  EXPECT_LT(unmoved, 10);
  EXPECT_NE(with(30), 0) << "never the bias";
  for (Index h = 0; h < 10; ++h) EXPECT_EQ(with(2 * h) == 0, with(20 + h) == 0) << "nor does its unit learn";
}

/// The learner that searches by gradient.
std::unique_ptr<LearnerBuilder> by_gradient(const std::string& name) {
  auto builder = slider::builder(name);
  const Fields fields = [&](FieldVisitor& v) { builder->fields(v); };
  for (const auto& [field, value] : {std::pair<std::string, std::string>{"search.method", "gradient"},
                                     {"search.gradient.steps", "60"},
                                     {"search.gradient.particles", "8"},
                                     {"search.gradient.descents", "4"},
                                     {"search.gradient.rounds", "2"},
                                     {"search.gradient.adam.step", "0.1"}})
    EXPECT_TRUE(set_field(fields, field, value));
  return builder;
}

class ByGradient : public ::testing::TestWithParam<const char*> {};

TEST_P(ByGradient, KeepsTheLawsAndLearnsTheSlider) {
  const auto builder = by_gradient(GetParam());
  EXPECT_EQ(testing::check_learner(*builder, slider::setting(), slider::run_trial), std::vector<std::string>{});
  const auto learner = builder->build(slider::setting(slider::prior(-1)));
  EXPECT_GT(slider::learn(*learner, 4).returns.back(), 7);
}

INSTANTIATE_TEST_SUITE_P(Names, ByGradient, ::testing::Values("black-drops", "gp-mi"), [](const auto& info) {
  std::string name = info.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(ByGradientTest, APolicyWithoutDerivativesIsRefused) {
  Setting setting = slider::setting();
  setting.policy = policy::make_schedule(setting.task);
  try {
    by_gradient("gp-mi")->build(setting);
    FAIL();
  } catch (const InvalidInput& refused) {
    EXPECT_NE(std::string(refused.what()).find("search.method"), std::string::npos) << refused.what();
  }
}

TEST(SearchPolicy, ByGradientFindsAPolicyAsGoodAsPredicted) {
  const dynamics::SimulatorModel model(slider::prior(), slider::kTruth, 0.0004);
  const auto policy = slider::policy();
  const Task task = slider::task();
  const ProgressSink silent;
  SearchOptions options;
  options.method = Method::gradient;
  options.gradient = few_steps();
  options.selection = 10;
  const SearchResult found =
      search_policy({model, *policy, task, serial_evaluator(), silent}, {}, options, {.stage = Stage::search});
  EXPECT_GT(found.predicted_return, 7);
  EXPECT_NEAR(value(found.theta), found.predicted_return, 1);
  EXPECT_EQ(found.rollouts, 120 * 8 + 4 * 10);
  EXPECT_FALSE(found.runners_up.empty());
}

TEST(SearchPolicy, ARaceIsPolishedByGradient) {
  const dynamics::SimulatorModel model(slider::prior(), slider::kTruth, 0.0004);
  const auto policy = slider::policy();
  const Task task = slider::task();
  double done = 0;
  const ProgressSink progress = [&](const Progress& at) {
    EXPECT_GE(at.done, done);
    done = at.done;
  };
  SearchOptions options;
  options.race.max_evaluations = 200;
  options.race.descents = 4;
  options.race.rounds = 2;
  options.race.judgements = 4;
  options.race.cmaes.population = 8;
  options.selection = 10;
  const auto found = [&](Method method) {
    options.method = method;
    options.gradient = few_steps();
    options.gradient.adam.step = 0.02;
    return search_policy({model, *policy, task, serial_evaluator(), progress}, {}, options, {.stage = Stage::search});
  };
  const SearchResult raced = found(Method::race);
  done = 0;
  const SearchResult polished = found(Method::polish);
  EXPECT_GT(polished.predicted_return, raced.predicted_return);
  EXPECT_EQ(polished.rollouts, raced.rollouts + 120 * 8);
  EXPECT_GT(done, 0.8);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
