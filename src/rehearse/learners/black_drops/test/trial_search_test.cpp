#include "rehearse/learners/black_drops/trial_search.hpp"

#include <map>

#include <gtest/gtest.h>

#include "rehearse/rollout/simulate.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

using slider::builder, slider::run_trial, slider::setting;

// With a gain that no search can reach, each is followed by one in the mean predictions.
TEST(TrialSearch, ExploresWhereASearchLeadsNoFurther) {
  const auto second = [](const char* gain, const char* required) {
    const auto with = builder("black-drops-prior", "100");
    for (const auto& [name, value] : std::map<std::string, std::string>{
             {"mean_search.policies", "0"}, {"explore.gain", gain}, {"explore.required", required}})
      EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, name, value));
    const auto learner = with->build(setting(slider::prior(-1)));
    learner->tell(run_trial(learner->ask(), 1));
    return learner->ask();
  };
  const Proposal never = second("0", "0"), always = second("1e12", "0"), in_vain = second("1e12", "1e12");
  EXPECT_GT(always.rollouts, never.rollouts + 100);
  EXPECT_NE(always.theta, never.theta);
  const auto mean = rollout::simulate_recorded(
      {*always.model, *always.policy, slider::task(), {.seed = 7, .stage = Stage::prediction}, {.sample = false}},
      always.theta, 100);
  EXPECT_NEAR(*always.predicted_return, mean.returns.mean(), 0.05);
  EXPECT_EQ(in_vain.rollouts, always.rollouts) << "searched";
  EXPECT_EQ(in_vain.theta, never.theta) << "but it gains too little";
}

// With seed 1 uncertainty costs the policy of the search in the means a little of its return.
TEST(TrialSearch, SearchesInTheMeanPredictionsFirst) {
  const auto second = [](const char* policies, const char* tolerance) {
    const auto with = builder("black-drops");
    for (const auto& [name, value] : std::map<std::string, std::string>{
             {"mean_search.policies", policies}, {"mean_search.tolerance", tolerance}, {"search.selection", "1000"}})
      EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, name, value));
    const auto learner = with->build(setting({}, 1));
    learner->tell(run_trial(learner->ask(), 1));
    return learner->ask();
  };
  const auto expected = [](const Proposal& proposal) {
    const StreamKey key{.seed = 7, .stage = Stage::prediction};
    return rollout::simulate_recorded({*proposal.model, *proposal.policy, slider::task(), key, {.noise_clip = 0}},
                                      proposal.theta, 1000)
        .returns.mean();
  };
  const Proposal none = second("0", "0"), both = second("3", "0"), alone = second("3", "1e12");
  EXPECT_NE(both.theta, none.theta);
  EXPECT_GT(both.rollouts, alone.rollouts + 100) << "a policy whose return stays saves the other search";
  EXPECT_GE(expected(both), expected(alone) - 0.05) << "what was found in the means is not lost";
  EXPECT_NEAR(*alone.predicted_return, expected(alone), 0.2) << "predicted is what uncertainty leaves";
}

}  // namespace
}  // namespace rehearse::learners::black_drops
