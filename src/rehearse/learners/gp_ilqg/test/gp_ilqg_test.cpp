#include "rehearse/learners/gp_ilqg/gp_ilqg.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/learners/test/slider.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/testing/check_learner.hpp"

namespace rehearse::learners::gp_ilqg {
namespace {

using learners::slider::learn, learners::slider::run_trial;

std::unique_ptr<LearnerBuilder> builder(bool identify = false) {
  auto builder = std::move(builders().front());
  const Fields fields = [&](FieldVisitor& v) { builder->fields(v); };
  for (const auto& [field, value] : {std::pair<std::string, std::string>{"search.starts", "3"},
                                     {"search.first_iterations", "5"},
                                     {"search.finalists", "2"},
                                     {"search.iterations", "10"},
                                     {"search.selection", "10"},
                                     {"identify", identify ? "true" : "false"}})
    EXPECT_TRUE(set_field(fields, field, value)) << field;
  return builder;
}

Setting setting(double gain, std::uint64_t seed = 1) {
  Setting setting;
  setting.task = learners::slider::task();
  setting.policy = policy::make_linear(
      {.features = FeatureMap({StateKind::plain}), .scale = Vector::Ones(1), .squash = {{{-1, 1}}, 1}});
  setting.prior = learners::slider::prior(gain);
  setting.seed = seed;
  return setting;
}

TEST(GpIlqg, TunesThePriorWhereItIsAsked) {
  EXPECT_FALSE(builder(false)->tunes_prior());
  EXPECT_TRUE(builder(true)->tunes_prior());
}

TEST(GpIlqg, KeepsTheLaws) {
  for (const bool identify : {false, true})
    EXPECT_EQ(testing::check_learner(*builder(identify), setting(1), run_trial), std::vector<std::string>{})
        << identify;
}

// A slider that stops at 0 at once earns about 9, one that is not moved about 0.
TEST(GpIlqg, LearnsFromAPriorThatPullsTheWrongWay) {
  for (const std::uint64_t seed : {1, 2})
    for (const bool identify : {false, true}) {
      const auto learner = builder(identify)->build(setting(-1, seed));
      const auto history = learn(*learner, 4);
      EXPECT_LT(history.returns.front(), 3);
      EXPECT_GT(history.returns.back(), 8) << seed << identify;
      const Proposal& last = history.proposals.back();
      ASSERT_TRUE(last.predicted_return && last.phi);
      EXPECT_NEAR(*last.predicted_return, history.returns.back(), 1);
      EXPECT_EQ(last.policy->name(), "tracking");
      EXPECT_NEAR((*last.phi)(0), identify ? 1.5 : -1, 0.1) << "the gain is learned where that is asked for";
    }
}

TEST(GpIlqg, RefusesRewardsOfWholeEpisodes) {
  Setting whole = setting(1);
  whole.task.episode_reward = [](const Episode&) { return 1; };
  EXPECT_THROW(builder()->build(whole), InvalidInput);
}

TEST(GpIlqg, RefusesLimits) {
  Setting limited = setting(1);
  limited.task.limits = {{.name = "end", .holds = [](const Steps&, VectorView kept) { kept.setOnes(); }}};
  EXPECT_THROW(builder()->build(limited), InvalidInput);
  Setting without = setting(1);
  without.prior.reset();
  EXPECT_THROW(builder()->build(without), InvalidInput);
}

}  // namespace
}  // namespace rehearse::learners::gp_ilqg
