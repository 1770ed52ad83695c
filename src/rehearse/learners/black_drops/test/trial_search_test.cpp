#include "rehearse/learners/black_drops/trial_search.hpp"

#include <map>

#include <gtest/gtest.h>

#include "rehearse/rollout/simulate.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

using slider::builder, slider::run_trial, slider::setting;

TEST(TrialSearch, PredictsTheReturnThatUncertaintyLeaves) {
  const auto with = builder("black-drops");
  EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, "search.selection", "1000"));
  const auto learner = with->build(setting({}, 1));
  learner->tell(run_trial(learner->ask(), 1));
  const Proposal second = learner->ask();
  const StreamKey key{.seed = 7, .stage = Stage::prediction};
  const auto expected = rollout::simulate_recorded(
      {*second.model, *second.policy, slider::task(), key, {.noise_clip = 0}}, second.theta, 1000);
  EXPECT_NEAR(*second.predicted_return, expected.returns.mean(), 0.2);
}

TEST(TrialSearch, SearchesOnThePriorGoOnFromTheBestOfTheOneBefore) {
  const auto first = [](const char* searches) {
    const auto with = builder("black-drops-prior", "100");
    for (const auto& [name, value] : std::map<std::string, std::string>{
             {"prior_searches", searches}, {"retry.searches", "0"}, {"search.selection", "100"}})
      EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, name, value));
    return with->build(setting(slider::prior(-1)))->ask();
  };
  const Proposal once = first("1"), thrice = first("3");
  EXPECT_GT(thrice.rollouts, 2 * once.rollouts);
  EXPECT_GE(*thrice.predicted_return, *once.predicted_return - 0.01);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
