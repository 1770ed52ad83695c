#include "rehearse/learners/pilco/pilco.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "learner.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/learners/pilco/model.hpp"
#include "rehearse/moments/expected_return.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/rollout/simulate.hpp"
#include "rehearse/testing/check_learner.hpp"

namespace rehearse::learners::pilco {
namespace {

using slider::asked_after, slider::builder, slider::learn, slider::linear, slider::rbf, slider::run_trial,
    slider::setting, slider::task;

TEST(Pilco, WarnsOfEarlyEndsThatItIgnores) {
  Task ending = task();
  for (const auto& each : builders()) {
    ending.ended = nullptr;
    EXPECT_TRUE(each->warnings(ending).empty());
    ending.ended = each_state([](const ConstVectorView&) { return false; });
    EXPECT_EQ(each->warnings(ending).size(), 1U);
  }
}

std::string refusal(const Setting& setting) {
  try {
    builder()->build(setting);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(Pilco, IsALearnerWithoutAPriorAndTwoWith) {
  const auto all = builders();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0]->name(), "pilco");
  EXPECT_EQ(all[0]->prior_use(), PriorUse::none);
  EXPECT_EQ(all[1]->name(), "pilco-prior");
  EXPECT_EQ(all[1]->prior_use(), PriorUse::required);
  EXPECT_EQ(all[2]->name(), "pi-rem");
  EXPECT_EQ(all[2]->prior_use(), PriorUse::required);
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

// The same whether or not the search summed the 12 rows up.
TEST(Pilco, ItsEpisodeByMomentsIsThatOfTheGpsOfAllRows) {
  for (const char* inducing : {"300", "8"}) {
    const auto [proposal, data] = asked_after(1, {{"search.line_searches", "5"}, {"model.inducing", inducing}});
    const Model model = pilco::learn({task(), data, ModelOptions{}, serial_evaluator()}, {});
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

}  // namespace
}  // namespace rehearse::learners::pilco
