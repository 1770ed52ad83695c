#include "rehearse/learners/pilco/pilco.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/learners/pilco/initial_policy.hpp"
#include "rehearse/moments/expected_return.hpp"
#include "rehearse/moments/requirements.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/rollout/simulate.hpp"
#include "rehearse/testing/check_learner.hpp"
#include "slider.hpp"

namespace rehearse::learners::pilco {
namespace {

using OptionTexts = std::map<std::string, std::string>;

using slider::learn, slider::linear, slider::rbf, slider::run_trial, slider::setting, slider::task;

std::unique_ptr<LearnerBuilder> builder(const OptionTexts& options = {{"search.line_searches", "20"}}) {
  auto builder = std::move(builders().front());
  for (const auto& [name, text] : options)
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { builder->fields(v); }, name, text)) << name;
  return builder;
}

std::string refusal(const Setting& setting) {
  try {
    builder()->build(setting);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(Pilco, IsALearnerWithoutAPriorAndOneWith) {
  const auto all = builders();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0]->name(), "pilco");
  EXPECT_EQ(all[0]->prior_use(), PriorUse::none);
  EXPECT_EQ(all[1]->name(), "pilco-prior");
  EXPECT_EQ(all[1]->prior_use(), PriorUse::required);
  for (const auto& each : all) {
    EXPECT_TRUE(field_violations([&](FieldVisitor& v) { each->fields(v); }).empty());
    const auto options = list_fields([&](FieldVisitor& v) { each->fields(v); });
    const std::pair<std::string, std::string> episodes{"pilco.prior_episodes", "40"};
    EXPECT_EQ(std::count(options.begin(), options.end(), episodes), each->name() == "pilco-prior");
    EXPECT_EQ(each->scenario_defaults(), (learners::OptionTexts{{"policy", "rbf"}}));
  }
}

TEST(Pilco, KeepsTheLaws) {
  EXPECT_EQ(testing::check_learner(*builder(), setting(), run_trial), std::vector<std::string>{});
}

TEST(Pilco, KeepsTheLawsWithALinearPolicy) {
  Setting with_linear = setting();
  with_linear.policy = linear();
  EXPECT_EQ(testing::check_learner(*builder(), with_linear, run_trial), std::vector<std::string>{});
}

TEST(Pilco, KeepsTheLawsWithInducingInputs) {
  const auto sparse = builder({{"search.line_searches", "10"}, {"model.inducing", "9"}});
  EXPECT_EQ(testing::check_learner(*sparse, setting(), run_trial), std::vector<std::string>{});
}

TEST(Pilco, KeepsTheLawsWithRestarts) {
  const auto restarting = builder({{"search.line_searches", "10"}, {"search.restarts", "2"}});
  EXPECT_EQ(testing::check_learner(*restarting, setting(), run_trial), std::vector<std::string>{});
}

TEST(Pilco, BeginsAnewUntilATrialSolvesTheTask) {
  const auto rollouts = [](bool solved, const char* restarts) {
    Setting with = setting();
    with.task.solved = [=](const Episode&) { return solved; };
    const auto learner = builder({{"search.line_searches", "10"}, {"search.restarts", restarts}})->build(with);
    return learn(*learner, 2).proposals.back().rollouts;
  };
  EXPECT_GT(rollouts(false, "2"), 2 * rollouts(false, "0"));
  EXPECT_EQ(rollouts(true, "2"), rollouts(true, "0"));
}

TEST(Pilco, BeginsAlwaysAnewWhereNothingSaysWhatIsSolved) {
  Setting unknown = setting();
  unknown.task.solved = nullptr;
  const auto restarting = builder({{"search.line_searches", "10"}, {"search.restarts", "2"}});
  EXPECT_EQ(testing::check_learner(*restarting, unknown, run_trial), std::vector<std::string>{});
  Setting unsolved = setting();
  unsolved.task.solved = [](const Episode&) { return false; };
  const auto thetas = [&](const Setting& with) {
    std::vector<Vector> thetas;
    for (const Proposal& proposal : learn(*restarting->build(with), 4).proposals) thetas.push_back(proposal.theta);
    return thetas;
  };
  EXPECT_EQ(thetas(unknown), thetas(unsolved));
}

// Rewards teach the GPs nothing, so the searches are the same.
TEST(Pilco, WhatEarnedTheSameTwicePromisesNoMore) {
  const auto promise = [](double second_return) {
    Setting unsolved = setting();
    unsolved.task.solved = nullptr;
    const auto learner = builder({{"search.line_searches", "20"}, {"search.restarts", "0"}})->build(unsolved);
    for (const double earned : {-5.0, second_return}) {
      Episode episode = run_trial(learner->ask(), 1);
      episode.rewards.setConstant(earned / static_cast<double>(episode.steps()));
      learner->tell(episode);
    }
    return *learner->ask().predicted_return;
  };
  const double uncorrected = promise(-6);
  EXPECT_GT(uncorrected, 0);
  EXPECT_LT(promise(-5), uncorrected - 5);
}

// A policy that does nothing earns about 0, one that stops at 0 at once about 9.
TEST(Pilco, LearnsTheSlider) {
  for (const auto& policy : {rbf(), linear()})
    for (const std::uint64_t seed : {1, 2}) {
      Setting with_policy = setting(seed);
      with_policy.policy = policy;
      const auto [proposals, returns] = learn(*builder()->build(with_policy), 4);
      EXPECT_GT(returns.back(), 8) << policy->name() << seed;
      const Proposal& last = proposals.back();
      ASSERT_TRUE(last.predicted_return && last.log_evidence && last.model);
      EXPECT_NEAR(*last.predicted_return, returns.back(), 1) << policy->name() << seed;
      EXPECT_EQ(last.policy, policy);
      EXPECT_EQ(last.notes, std::vector<std::string>{});
      EXPECT_GT(last.rollouts, 20);
    }
}

TEST(Pilco, TheFirstTrialIsRandomActions) {
  const auto first = [](std::uint64_t seed, const char* hold_s) {
    const Proposal proposal = builder({{"first_trial.hold_s", hold_s}})->build(setting(seed))->ask();
    EXPECT_EQ(proposal.policy->name(), "schedule");
    EXPECT_FALSE(proposal.predicted_return || proposal.log_evidence || proposal.model || proposal.moments);
    return proposal.theta;
  };
  EXPECT_EQ(first(1, "0"), first(1, "0"));
  EXPECT_NE(first(1, "0"), first(2, "0"));
  EXPECT_NE(first(1, "0")(0), first(1, "0")(1));
  EXPECT_EQ(first(1, "0.4")(0), first(1, "0.4")(1));
  const Vector held = first(1, "1e300");
  EXPECT_TRUE((held.array() == held(0)).all());
}

TEST(Pilco, RefusesWhatHasNoMoments) {
  Setting plain = setting();
  plain.policy =
      policy::make_linear({.features = task().feature_map(), .scale = Vector::Ones(1), .squash = {{{-1, 1}}, 1}});
  plain.task.reward = learners::slider::reward;
  const std::string message = refusal(plain);
  for (const char* part :
       {"policy = linear", "--set policy=rbf", "policy_squash = sine", "reward", "closed form", "black-drops"})
    EXPECT_NE(message.find(part), std::string::npos) << part << ": " << message;
  EXPECT_EQ(builder()->violations(plain.task, *plain.policy).size(), 2U);
  EXPECT_TRUE(builder()->violations(task(), *rbf()).empty());
}

// The 24 rows of two trials by 8 inducing inputs: another model than the exact one, and nearly as good.
TEST(Pilco, SumsUpManyRowsByInducingInputs) {
  const auto third = [](const char* inducing) {
    return learn(*builder({{"search.line_searches", "20"}, {"model.inducing", inducing}})->build(setting()), 3)
        .proposals.back();
  };
  const Proposal exact = third("24"), sparse = third("8");
  EXPECT_NE(exact.theta, sparse.theta);
  EXPECT_NEAR(*exact.predicted_return, *sparse.predicted_return, 0.3);
}

/// The last proposal of some trials, and the data that it was learned from.
struct Asked {
  Proposal proposal;
  Dataset data;
};
Asked asked_after(std::uint64_t trials, const OptionTexts& options) {
  const auto learner = builder(options)->build(setting());
  Dataset data;
  for (std::uint64_t trial = 1; trial <= trials; ++trial) {
    const Episode episode = run_trial(learner->ask(), trial);
    data.append(episode);
    learner->tell(episode);
  }
  return {learner->ask(), data};
}

// Whether the search summed the 12 rows up or not.
TEST(Pilco, ItsEpisodeByMomentsIsThatOfTheGpsOfAllRows) {
  for (const char* inducing : {"300", "8"}) {
    const auto [proposal, data] = asked_after(1, {{"search.line_searches", "5"}, {"model.inducing", inducing}});
    const Model model = pilco::learn(task(), data, {}, {}, serial_evaluator());
    const moments::ExpectedReturn expected(task(), *rbf(), model.moments);
    moments::ReturnWorkspace workspace;
    const moments::Return result = expected(proposal.theta, nullptr, workspace);
    ASSERT_TRUE(result.ok() && proposal.moments);
    const ExpectedEpisode episode = proposal.moments();
    EXPECT_EQ(episode.rewards, result.rewards);
    for (Index t = 0; t <= task().horizon; ++t)
      EXPECT_EQ(episode.states.row(t), workspace.states[static_cast<std::size_t>(t)].mean.transpose());
  }
}

// Moment matching is exact for one step. 10⁵ samples; five standard errors: false alarms below 2e-6 in all.
TEST(Pilco, OneStepByMomentsIsThatOfTheSamples) {
  const Proposal proposal = asked_after(2, {{"search.line_searches", "20"}}).proposal;
  constexpr Index kSamples = 100000;
  const auto recorded = rollout::simulate_recorded({*proposal.model,
                                                    *proposal.policy,
                                                    task(),
                                                    {.seed = 3, .trial = 1, .stage = Stage::prediction},
                                                    {.noise_clip = 0}},
                                                   proposal.theta, kSamples);
  const ExpectedEpisode episode = proposal.moments();
  const auto expect_moments = [](const Vector& samples, double mean, double deviation) {
    const double error = deviation / std::sqrt(kSamples), found = samples.mean();
    EXPECT_NEAR(found, mean, 5 * error);
    const Vector squares = (samples.array() - mean).square();
    const double error_of_squares = std::sqrt((squares.array() - squares.mean()).square().mean() / kSamples);
    EXPECT_NEAR(squares.mean(), deviation * deviation, 5 * error_of_squares);
  };
  expect_moments(recorded.states[1].col(0), episode.states(1, 0), episode.state_deviations(1, 0));
  expect_moments(recorded.rewards.col(0), episode.rewards(0), episode.reward_deviations(0));
}

TEST(Model, HasInducingInputsBeyondTheLimitOnly) {
  const auto learner = builder()->build(setting());
  Dataset data;
  for (const std::uint64_t trial : {1, 2}) data.append(run_trial(learner->ask(), trial));
  const auto points = [&](Index inducing) {
    ModelOptions options;
    options.inducing = inducing;
    const Model model = pilco::learn(task(), data, options, {}, serial_evaluator());
    EXPECT_EQ(model.notes, std::vector<std::string>{});
    return model.moments->terms().front().size();
  };
  EXPECT_EQ(points(24), 24);
  EXPECT_EQ(points(23), 23);
  EXPECT_EQ(points(8), 8);
}

/// Two links of which nothing but the angle between them matters, in states of no particular order.
Dataset two_links(double noise) {
  Rng rng({.seed = 7});
  constexpr Index kSteps = 40;
  Episode episode{.actions = Matrix(kSteps, 1), .rewards = Vector::Zero(kSteps)};
  Matrix X(kSteps + 1, 3);
  X.row(0) << 0, 0.3, -0.5;
  for (Index t = 0; t < kSteps; ++t) {
    const double u = episode.actions(t, 0) = rng.uniform(-1, 1), turn = 0.5 * u + 0.2;
    X.row(t + 1) = X.row(t) + Eigen::RowVector3d(std::sin(X(t, 2) - X(t, 1)) + 0.3 * u, turn, 0.1 - 2 * turn);
  }
  episode.true_states = X;
  for (double& x : X.reshaped()) x += noise * rng.normal();
  episode.states = X;
  Dataset data;
  data.append(episode);
  return data;
}
Task two_link_task() {
  Task task = slider::task();
  task.states = {{"v", "m/s"}, {"a", "rad", StateKind::angle}, {"b", "rad", StateKind::angle, "", "a"}};
  return task;
}

// The last two features of a model with joint angles are cosine and sine of theirs, before the action.
TEST(Model, HasJointAnglesAsInputsWhereTheTaskNamesThem) {
  const Dataset data = two_links(0);
  ModelOptions options;
  const Model with = pilco::learn(two_link_task(), data, options, {}, serial_evaluator());
  options.joint_angles = false;
  const Model without = pilco::learn(two_link_task(), data, options, {}, serial_evaluator());
  ASSERT_TRUE(with.moments && without.moments);
  EXPECT_EQ(with.moments->inputs(), 8);
  EXPECT_EQ(without.moments->inputs(), 6);
  EXPECT_GT(with.log_evidence, without.log_evidence + 10);

  const moments::Gaussian known{Vector{{0.1, 0.4, -0.9}}, Matrix::Zero(3, 3)};
  moments::Gaussian inputs = moments::Gaussian::zero(8);
  inputs.mean << moments::FeatureMoments(moments::model_features(two_link_task(), true))(known).mean, 0.2;
  moments::MomentTape tape;
  moments::Transformed change = moments::Transformed::zero(8, 3);
  ASSERT_TRUE(with.moments->forward(inputs, tape, change));
  Matrix mean(1, 3), variance(1, 3);
  with.model->predict(known.mean.transpose(), Matrix::Constant(1, 1, 0.2), mean, variance);
  EXPECT_LT((change.mean - mean.transpose()).norm(), 0.02) << "forecasts and searches have the same inputs";
}

// With so much measurement noise smoothing is likelier.
TEST(Model, SearchesAndForecastsLearnFromTheSameStatesSmoothedOrNot) {
  const Dataset data = two_links(0.05);
  const FeatureMap features = moments::model_features(two_link_task(), true);
  const Matrix inputs = dynamics::gp_inputs(features, data.states, data.actions);
  const auto learned = [&](const ModelOptions& options, const std::vector<moments::MomentTerm>& around) {
    Model model = pilco::learn(two_link_task(), data, options, {}, serial_evaluator(), around);
    Matrix of_forecast(data.size(), 3);
    model.model->predict_mean(data.states, data.actions, of_forecast);
    const Matrix of_search = moments::evaluate_means(model.moments->terms(), 3, inputs);
    EXPECT_LT((of_search - of_forecast).cwiseAbs().maxCoeff(), 2e-3);  // forecasts may be off by 0.01 σ_n
    return model;
  };
  ModelOptions options;
  const Model plain = learned(options, {});
  std::vector<moments::MomentTerm> half = moments::mean_terms(plain.moments->terms());
  for (moments::MomentTerm& term : half) term.weights *= 0.5;
  learned(options, half);
  options.smooth = true;
  EXPECT_GT(learned(options, {}).log_evidence, plain.log_evidence + 0.15 * 3 * 40) << "it was smoothed";
  learned(options, half);
}

TEST(Model, CanBeInterruptedWhileItPlacesInducingInputs) {
  const Dataset data = asked_after(2, {{"search.line_searches", "5"}}).data;
  ModelOptions options;
  options.inducing = 8;
  const auto stop = [](const Progress&) { throw std::runtime_error("stopped"); };
  EXPECT_THROW(pilco::learn(task(), data, options, {}, serial_evaluator(), {}, stop), std::runtime_error);
}

TEST(Model, SurvivesDataThatTellNothing) {
  Dataset data;
  data.states = Matrix::Constant(3, 1, std::numeric_limits<double>::quiet_NaN());
  data.actions = Matrix::Zero(3, 1);
  data.changes = data.states;
  data.rewards = Vector::Zero(3);
  const Model model = pilco::learn(task(), data, {}, {}, serial_evaluator());
  EXPECT_FALSE(model.moments || model.model);
  ASSERT_EQ(model.notes.size(), 1U);
  EXPECT_NE(model.notes[0].find("the policy stays"), std::string::npos) << model.notes[0];
}

TEST(PolicySearch, BeginsWithPilcosPolicyWhateverTheScale) {
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

TEST(PolicySearch, BeginsWithALinearPolicyOfTheSameActionsWhateverTheScaleAndTheGain) {
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

// No policy has a value on a model that throws the state out of all numbers.
TEST(PolicySearch, KeepsTheStartWhereNothingHasAValue) {
  moments::MomentTerm wild{.centres = Matrix{{1, 0}}, .log_lengths = Vector{{9, 9}}, .weights = Vector{{1e300}}};
  const auto dynamics = std::make_shared<moments::MomentMatching>(std::vector{wild}, 1);
  const auto policy = rbf();
  const Task task = slider::task();
  const Vector start = initial_policy(*policy, start_state(task, {}), {.seed = 1, .trial = 2});
  const SearchResult found = search_policy({dynamics, *policy, task, serial_evaluator(), {}}, start, {});
  EXPECT_EQ(found.theta, start);
  EXPECT_FALSE(found.predicted_return.has_value());
  EXPECT_EQ(found.failed, found.evaluations);
}

TEST(PolicySearch, TakesTheBestOfItsRestarts) {
  const auto dynamics =
      pilco::learn(task(), asked_after(2, {{"search.line_searches", "5"}}).data, {}, {}, serial_evaluator()).moments;
  const auto policy = rbf();
  const Task task = slider::task();
  const SearchProblem problem{dynamics, *policy, task, serial_evaluator(), {}};
  const SearchOptions options{.bfgs = {.line_searches = 30}, .restarts = 3};
  const auto first_policy = [&](std::uint64_t candidate) {
    return initial_policy(*policy, start_state(task, options), {.seed = 1, .trial = 2, .candidate = candidate});
  };
  const StreamKey key{.seed = 1, .trial = 2};
  std::vector<SearchResult> all{search_policy(problem, first_policy(0), options)};
  Index evaluations = all.front().evaluations;
  for (const std::uint64_t candidate : {1, 2, 3})
    evaluations += all.emplace_back(search_policy(problem, first_policy(candidate), options)).evaluations;
  const auto& best = *std::max_element(all.begin(), all.end(), [](const SearchResult& a, const SearchResult& b) {
    return a.predicted_return < b.predicted_return;
  });
  const SearchResult found = search_with_restarts(problem, first_policy(0), options, key);
  EXPECT_EQ(found.theta, best.theta);
  EXPECT_EQ(found.predicted_return, best.predicted_return);
  EXPECT_EQ(found.evaluations, evaluations);

  const double promised = *all.front().predicted_return;
  const SearchResult disappointed = search_with_restarts(problem, first_policy(0), options, key, promised - 1000);
  const auto& other = *std::max_element(all.begin() + 1, all.end(), [](const SearchResult& a, const SearchResult& b) {
    return a.predicted_return < b.predicted_return;
  });
  EXPECT_EQ(disappointed.theta, other.theta);
  EXPECT_EQ(disappointed.predicted_return, other.predicted_return);
  const SearchResult surprised = search_with_restarts(problem, first_policy(0), options, key, promised + 1000);
  EXPECT_EQ(surprised.theta, best.theta);
  EXPECT_EQ(surprised.predicted_return, best.predicted_return);

  SearchOptions none = options;
  none.restarts = 0;
  EXPECT_EQ(search_with_restarts(problem, first_policy(0), none, key).theta, all.front().theta);
}

TEST(PolicySearch, ReportsProgressAndPassesInterruptions) {
  const auto learner_with = [](ProgressSink sink) {
    Setting with = setting();
    with.progress = std::move(sink);
    return builder()->build(with);
  };
  std::vector<Progress> events;
  const auto learner = learner_with([&](const Progress& p) { events.push_back(p); });
  learn(*learner, 2);
  ASSERT_GT(events.size(), 2U);
  EXPECT_EQ(events.front().phase, "model");
  EXPECT_EQ(events.back().phase, "search");
  EXPECT_EQ(events.back().rollouts, static_cast<Index>(events.size()) - 1);

  bool stop = true;
  const auto stopped = learner_with([&](const Progress& p) {
    if (stop && p.phase == "search" && p.rollouts == 3) throw Interrupted();
  });
  stopped->tell(run_trial(stopped->ask(), 1));
  EXPECT_THROW(stopped->ask(), Interrupted);
  stop = false;
  EXPECT_EQ(stopped->ask().theta, learn(*learner_with({}), 2).proposals.back().theta);
}

}  // namespace
}  // namespace rehearse::learners::pilco
