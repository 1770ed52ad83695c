// The entry pi-rem of the family: its model, its first policy, its laws.

#include <cmath>

#include <gtest/gtest.h>

#include "learner.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/moments/expected_return.hpp"
#include "rehearse/testing/check_learner.hpp"

namespace rehearse::learners::pilco {
namespace {

using slider::learn, slider::OptionTexts, slider::rbf, slider::run_trial, slider::setting, slider::task;

/// Gain and drag of the prior are wrong; the robot's are 1.5 and 0.2, the prior's drag is 0.5.
Setting setting_with_a_prior(std::uint64_t seed = 1, double gain = 0.7) {
  Setting with = setting(seed);
  with.prior = learners::slider::prior(gain);
  return with;
}

std::unique_ptr<LearnerBuilder> pi_rem(const OptionTexts& more = {}) {
  OptionTexts options = {{"search.line_searches", "15"}, {"search.restarts", "0"}, {"search.prior_searches", "1"}};
  for (const auto& [name, text] : more) options[name] = text;
  auto builder = std::move(builders().back());
  EXPECT_EQ(builder->name(), "pi-rem");
  for (const auto& [name, text] : options)
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { builder->fields(v); }, name, text)) << name;
  return builder;
}

TEST(PiRem, KeepsTheLaws) {
  for (const OptionTexts& options :
       {OptionTexts{}, {{"model.through", "unscented"}}, {{"model.identify", "true"}}, {{"model.inducing", "9"}}})
    EXPECT_EQ(testing::check_learner(*pi_rem(options), setting_with_a_prior(), run_trial), std::vector<std::string>{});
}

TEST(PiRem, BeginsWithAPolicyForThePriorAlone) {
  Setting known = setting();
  known.prior = learners::slider::prior_in(
      ParameterSpace({Parameter::fixed("gain", 1.5, ""), Parameter::fixed("drag", 0.2, "")}));
  const auto learner = pi_rem({{"search.line_searches", "40"}, {"search.prior_searches", "3"}})->build(known);
  const Proposal first = learner->ask();
  EXPECT_EQ(first.policy, known.policy);
  ASSERT_TRUE(first.predicted_return && first.phi && first.model && first.moments);
  EXPECT_FALSE(first.log_evidence);
  EXPECT_EQ(*first.phi, (Vector{{1.5, 0.2}}));
  EXPECT_TRUE(first.model->certain());
  const double earned = run_trial(first, 1).total_reward();
  EXPECT_GT(earned, 8);
  EXPECT_NEAR(*first.predicted_return, earned, 0.3);
}

// A policy that does nothing earns about 0, one that stops at 0 at once about 9. The prior pushes where the robot
// pulls.
TEST(PiRem, LearnsTheSliderAroundAWrongPrior) {
  for (const char* through : {"linearised", "unscented"})
    for (const std::uint64_t seed : {1, 2}) {
      const auto learner =
          pi_rem({{"model.through", through}, {"search.restarts", "2"}, {"search.prior_searches", "3"}})
              ->build(setting_with_a_prior(seed, -0.7));
      const auto [proposals, returns] = learn(*learner, 4);
      EXPECT_GT(returns.back(), 8) << through << seed;
      EXPECT_LT(returns.front(), 1) << through << seed;
      const Proposal& last = proposals.back();
      ASSERT_TRUE(last.predicted_return && last.log_evidence && last.model && last.phi);
      EXPECT_NEAR(*last.predicted_return, returns.back(), 0.5) << through << seed;
      EXPECT_EQ(*last.phi, (Vector{{-0.7, 0.5}})) << "the prior stays as it was given";
      EXPECT_EQ(last.notes, std::vector<std::string>{});
    }
}

TEST(PiRem, IdentifiesThePriorWhereItIsAsked) {
  const auto builder = pi_rem({{"model.identify", "true"}});
  EXPECT_TRUE(builder->tunes_prior());
  EXPECT_FALSE(pi_rem()->tunes_prior());
  const auto learner = builder->build(setting_with_a_prior());
  const auto [proposals, returns] = learn(*learner, 3);
  EXPECT_EQ(*proposals.front().phi, (Vector{{0.7, 0.5}}));
  EXPECT_NEAR((*proposals.back().phi)(0), 1.5, 0.05);
  EXPECT_NEAR((*proposals.back().phi)(1), 0.2, 0.05);
  EXPECT_TRUE(proposals.back().posterior);
  EXPECT_GT(returns.back(), 8);
}

// The changes of a robot that is the prior are all known: what is left is 0.
TEST(PiRem, SearchesAndForecastsAreOfTheSameModel) {
  const Setting with = setting_with_a_prior();
  Dataset data;
  data.append(run_trial(pi_rem()->build(with)->ask(), 1));
  const Mean mean{.prior = &*with.prior};
  const Model model = pilco::learn({task(), data, ModelOptions{}, serial_evaluator()}, {}, mean);
  ASSERT_TRUE(model.moments.gps && model.moments.prior);
  Matrix forecast(data.size(), 1), change(data.size(), 1);
  model.model->predict_mean(data.states, data.actions, forecast);
  with.prior->mean(data.states, data.actions, with.prior->space.values(), change);
  change += moments::evaluate_means(model.moments.gps->terms(), 1,
                                    dynamics::gp_inputs(task().feature_map(), data.states, data.actions));
  EXPECT_LT((forecast - change).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT((data.changes - change).cwiseAbs().maxCoeff(), 1e-2);
}

TEST(PiRem, StaysWithThePolicyWhereTheDataTellNothing) {
  const Setting with = setting_with_a_prior();
  Dataset data;
  data.states = Matrix::Constant(3, 1, kNaN);
  data.actions = Matrix::Zero(3, 1);
  data.changes = data.states;
  data.rewards = Vector::Zero(3);
  const Model model = pilco::learn({task(), data, ModelOptions{}, serial_evaluator()}, {}, Mean{.prior = &*with.prior});
  EXPECT_FALSE(model.moments || model.model);
  ASSERT_EQ(model.notes.size(), 1U);
  EXPECT_NE(model.notes[0].find("the policy stays"), std::string::npos) << model.notes[0];
}

// Beyond 0.985 m it cannot say anything: not of the mean of the starts, nor of the first step of the trial.
TEST(PiRem, SurvivesAPriorThatFails) {
  Setting hostile = setting_with_a_prior();
  const auto change = [](const ConstMatrixView& X, const ConstMatrixView& U, const Vector&, MatrixView dX) {
    dX = (X.array() > 0.985).select(Matrix::Constant(X.rows(), 1, kNaN), 0.2 * U);
  };
  hostile.prior = prior::Prior{"hostile", system::make_simulator({}, change), {}};
  const auto [proposals, returns] = learn(*pi_rem()->build(hostile), 2);
  EXPECT_FALSE(proposals.front().predicted_return);
  EXPECT_EQ(proposals.front().notes.size(), 1U);
  EXPECT_GT(proposals.back().left_out_rows, 0);
}

TEST(PiRem, RefusesWhatHasNoMomentsAndNeedsAPrior) {
  Setting wrong = setting();
  wrong.task.reward = learners::slider::reward;
  try {
    pi_rem()->build(wrong);
    FAIL() << "built";
  } catch (const InvalidInput& error) {
    const std::string message = error.what();
    for (const char* part : {"pi-rem needs", "closed form", "black-drops-prior", "needs a prior"})
      EXPECT_NE(message.find(part), std::string::npos) << part << ": " << message;
  }
}

}  // namespace
}  // namespace rehearse::learners::pilco
