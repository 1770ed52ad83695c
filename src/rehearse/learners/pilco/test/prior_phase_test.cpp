#include "rehearse/learners/pilco/prior_phase.hpp"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/learners/pilco/model.hpp"
#include "rehearse/learners/test/memory_store.hpp"
#include "rehearse/moments/expected_return.hpp"
#include "rehearse/testing/check_learner.hpp"
#include "slider.hpp"

namespace rehearse::learners::pilco {
namespace {

using slider::learn, slider::run_trial, slider::task;

/// A slider that is thought to be pulled a third as strongly.
Setting setting_with_prior(std::uint64_t seed = 1) {
  Setting setting = slider::setting(seed);
  setting.prior = slider::prior(0.5, 0);
  return setting;
}

Options options(Index prior_episodes = 3, Index line_searches = 20) {
  Options options;
  options.prior = PriorPhaseOptions{.episodes = prior_episodes};
  options.search.bfgs.line_searches = line_searches;
  return options;
}

std::unique_ptr<LearnerBuilder> builder_with_prior(const char* line_searches) {
  auto builder = std::move(builders().at(1));
  const Fields fields = [&](FieldVisitor& v) { builder->fields(v); };
  EXPECT_TRUE(set_field(fields, "pilco.prior_episodes", "2"));
  EXPECT_TRUE(set_field(fields, "search.line_searches", line_searches));
  return builder;
}

void expect_same(const PriorKnowledge& a, const PriorKnowledge& b) { EXPECT_EQ(to_json(a), to_json(b)); }

TEST(PriorPhase, ALearnerWithAPriorKeepsTheLaws) {
  EXPECT_EQ(testing::check_learner(*builder_with_prior("10"), setting_with_prior(), run_trial),
            std::vector<std::string>{});
}

TEST(PriorPhase, TheFirstTrialIsThePolicyOfThePrior) {
  const PriorKnowledge knowledge = learn_on_prior(setting_with_prior(), options());
  const auto learner = make(setting_with_prior(), options());
  const Proposal& first = learner->ask();
  EXPECT_EQ(first.policy->name(), "rbf");
  EXPECT_EQ(first.theta, knowledge.theta);
  ASSERT_TRUE(first.predicted_return && first.model && first.phi);
  EXPECT_FALSE(first.log_evidence);
  EXPECT_EQ(*first.phi, (Vector{{0.5, 0}}));
  EXPECT_EQ(first.rollouts, knowledge.evaluations);
  EXPECT_GT(first.rollouts, 60) << "of all searches on the prior";

  // By moments it is that of the network alone.
  ASSERT_TRUE(first.moments);
  const moments::ExpectedReturn expected(task(), *slider::rbf(),
                                         std::make_shared<const moments::MomentMatching>(knowledge.network, 1));
  EXPECT_EQ(first.moments().states, expected.episode(first.theta).states);

  // On the prior it does as well as was predicted.
  const prior::Prior prior = slider::prior(0.5, 0);
  const Episode there =
      rollout::execute({prior.simulator, prior.space.values()}, *first.policy, first.theta, task(), Rng({}));
  EXPECT_NEAR(there.total_reward(), *first.predicted_return, 1.5);
}

TEST(PriorPhase, LearnsTheRealSliderFromThere) {
  for (const std::uint64_t seed : {1, 2}) {
    const auto [proposals, returns] = learn(*make(setting_with_prior(seed), options(3, 40)), 3);
    EXPECT_GT(returns.back(), 8) << seed;
    EXPECT_GE(returns.back(), returns.front()) << seed;
    const Proposal& last = proposals.back();
    ASSERT_TRUE(last.predicted_return && last.log_evidence && last.model && last.phi);
    EXPECT_NEAR(*last.predicted_return, returns.back(), 1) << seed;
    EXPECT_EQ(last.notes, std::vector<std::string>{});
  }
}

TEST(PriorPhase, GoesOnFromTheStoreAfterEachEpisode) {
  const PriorKnowledge whole = learn_on_prior(setting_with_prior(), options());
  for (const Index stop_after : {0, 1, 2, 3}) {
    const auto store = std::make_shared<MemoryStore>();
    Setting interrupted = setting_with_prior();
    interrupted.store = store;
    interrupted.progress = [&](const Progress& progress) {
      if (progress.phase == "prior " + std::to_string(stop_after) + "/3: search" && progress.rollouts == 3)
        throw Interrupted();
    };
    if (stop_after > 0) {
      EXPECT_THROW(learn_on_prior(interrupted, options()), Interrupted);
    }
    EXPECT_EQ(store->writes, stop_after);
    std::vector<std::string> phases;
    interrupted.progress = [&](const Progress& progress) { phases.push_back(progress.phase); };
    expect_same(learn_on_prior(interrupted, options()), whole);
    EXPECT_EQ(store->writes, 4) << "each episode, and the end";
    if (stop_after > 0) {
      EXPECT_EQ(phases.front(), "prior " + std::to_string(stop_after) + "/3: model");
    }

    phases.clear();
    expect_same(learn_on_prior(interrupted, options()), whole);
    EXPECT_TRUE(phases.empty()) << "the second time nothing is computed";
  }
}

/// The state kept after two of three episodes, with one of them lost.
std::string contradiction() {
  Setting with_store = setting_with_prior();
  const auto store = std::make_shared<MemoryStore>();
  with_store.store = store;
  with_store.progress = [](const Progress& progress) {
    if (progress.phase == "prior 2/3: search") throw Interrupted();
  };
  EXPECT_THROW(learn_on_prior(with_store, options()), Interrupted);
  nlohmann::json kept = nlohmann::json::from_cbor(store->kept["prior"]);
  kept["work"]["episodes"].erase(0);
  std::string bytes;
  nlohmann::json::to_cbor(kept, bytes);
  return bytes;
}

TEST(PriorPhase, BeginsAnewWhereTheStoreHoldsSomethingElse) {
  const PriorKnowledge whole = learn_on_prior(setting_with_prior(), options(1));
  for (const std::string& bytes : {std::string("not CBOR"), std::string("\xa0"), std::string(), contradiction()}) {
    Setting with_store = setting_with_prior();
    const auto store = std::make_shared<MemoryStore>();
    store->kept["prior"] = bytes;
    with_store.store = store;
    expect_same(learn_on_prior(with_store, options(1)), whole);
  }
}

TEST(PriorPhase, SurvivesASimulatorThatFails) {
  Setting broken = setting_with_prior();
  const ParameterSpace none;
  const auto fails_on_the_left = [](const ConstMatrixView& X, const ConstMatrixView& U, const Vector&, MatrixView dX) {
    dX = (X.array() < 0.9).select(kNaN, 0.1 * U.array()).matrix();
  };
  broken.prior = prior::Prior{"broken", system::make_simulator(none, fails_on_the_left), none};
  const auto learner = make(broken, options(2, 5));
  EXPECT_EQ(learner->ask().theta.size(), slider::rbf()->parameters());
  const std::vector<std::string>& notes = learner->ask().notes;
  ASSERT_FALSE(notes.empty());
  EXPECT_TRUE(notes[0].starts_with("on the prior, episode ") && notes[0].ends_with(" is not finite")) << notes[0];
  learner->tell(run_trial(learner->ask(), 1));
  EXPECT_TRUE(learner->ask().model);
}

TEST(PriorPhase, MovesNoRobotByAPriorThatMakesNoStep) {
  Setting broken = setting_with_prior();
  const ParameterSpace none;
  const auto fails = [](const ConstMatrixView&, const ConstMatrixView&, const Vector&, MatrixView) { throw 1; };
  broken.prior = prior::Prior{"broken", system::make_simulator(none, fails), none};
  const auto learner = make(broken, options(2, 5));
  try {
    learner->ask();
    FAIL() << "it proposes a policy";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(
        error.what(),
        std::string("none of 2 episodes on the prior has a step: the state at step 1 is not finite. No policy was "
                    "learned that could move the robot"));
  }
}

TEST(PriorPhase, EndsWithEpisodesThatTeachNothing) {
  const auto returns = [](Index settled) {
    std::vector<double> all;
    Setting with = setting_with_prior();
    with.task.solved = [&](const Episode& episode) {
      all.push_back(episode.total_reward());
      return false;
    };
    Options ten = options(10, 40);
    ten.prior->settled = settled;
    learn_on_prior(with, ten);
    return all;
  };
  const std::vector<double> whole = returns(0), settled = returns(2);
  EXPECT_EQ(whole.size(), 10U);
  ASSERT_GE(settled.size(), 4U);
  ASSERT_LT(settled.size(), 10U);
  EXPECT_TRUE(std::equal(settled.begin(), settled.end(), whole.begin()));
  EXPECT_LT(returns(1).size(), settled.size());
  const auto last = settled.end() - 2;
  const double before = *std::max_element(settled.begin(), last);
  for (auto each = last; each != settled.end(); ++each) EXPECT_LE(*each, 1.021 * before);
  EXPECT_GT(before, 0.95 * *std::max_element(whole.begin(), whole.end())) << "nothing was left to learn";
}

TEST(PriorPhase, HandsOverNoMorePointsThanAsked) {
  const auto points = [](Index inducing) {
    Options three = options(3, 5);
    three.prior->inducing = inducing;
    return learn_on_prior(setting_with_prior(), three).network.front().size();
  };
  EXPECT_EQ(points(7), 7);
  EXPECT_EQ(points(300), 3 * task().horizon);
}

TEST(PriorPhase, NeedsAPrior) {
  try {
    make(slider::setting(), options());
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("needs a prior"), std::string::npos);
  }
  EXPECT_THROW(make(setting_with_prior(), options(0)), InvalidInput);
}

// The GPs of the real slider around those of the prior: moments are of the sum, and so is the model for forecasts.
TEST(PriorPhase, ModelsAreAroundTheNetwork) {
  const PriorKnowledge knowledge = learn_on_prior(setting_with_prior(), options(2));
  ASSERT_EQ(knowledge.network.size(), 1U);
  EXPECT_EQ(knowledge.network[0].variance, 0);
  EXPECT_EQ(knowledge.network[0].reduction.size(), 0);
  expect_same(to_knowledge(to_json(knowledge)), knowledge);

  Dataset data;
  const auto random = make(slider::setting(), {});
  data.append(run_trial(random->ask(), 1));
  const Model model =
      pilco::learn({task(), data, ModelOptions{}, serial_evaluator()}, {}, {.network = knowledge.network});
  ASSERT_TRUE(model.moments.gps && model.model);
  ASSERT_EQ(model.moments.gps->terms().size(), 2U);
  const Matrix X{{0.3}}, U{{0.4}};
  Matrix mean(1, 1), variance(1, 1);
  model.model->predict(X, U, mean, variance);
  moments::MomentTape tape;
  moments::Transformed moments;
  ASSERT_TRUE(model.moments.gps->forward({Vector{{0.3, 0.4}}, Matrix::Zero(2, 2)}, tape, moments));
  EXPECT_NEAR(moments.mean(0), mean(0, 0), 1e-4) << "forecasts leave out points that do not matter";
  EXPECT_NEAR(moments.mean(0), 0.2 * (1.5 * 0.4 - 0.2 * 0.3), 0.01);
  const Model around_zero = pilco::learn({task(), data, ModelOptions{}, serial_evaluator()}, {});
  EXPECT_NE(model.log_evidence, around_zero.log_evidence);
}

}  // namespace
}  // namespace rehearse::learners::pilco
