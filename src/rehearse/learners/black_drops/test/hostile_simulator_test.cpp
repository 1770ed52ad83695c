#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/learners/black_drops/black_drops.hpp"
#include "rehearse/testing/hostile.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

using slider::builder, slider::learn, slider::setting;

// Failures are drawn by a hash of the row: nothing is left to chance but the seed. 1000 rollouts of 12 rows each, of
// which 0.1 % are spoilt: 12 failures are expected, none has probability 6e-6.
TEST(HostileSimulator, AFewFailuresEndNoRun) {
  for (const char* name : slider::kWithPrior) {
    for (const auto harm : {testing::Harm::nan, testing::Harm::huge, testing::Harm::exception}) {
      prior::Prior prior = slider::prior();
      prior.simulator = testing::make_hostile(prior.simulator, harm, 0.001);
      const auto learner = builder(name, "1000")->build(setting(prior));
      const slider::History history = learn(*learner, 3);
      EXPECT_GT(history.proposals[0].failed_rollouts, 0) << name;
      EXPECT_LT(history.proposals[0].failed_rollouts, 60) << name;
      for (const Proposal& proposal : history.proposals) EXPECT_TRUE(std::isfinite(*proposal.predicted_return));
      EXPECT_GT(history.returns.back(), 7) << name;
    }
  }
}

TEST(HostileSimulator, TrainingRowsThatFailAreCounted) {
  prior::Prior prior = slider::prior();
  prior.simulator = testing::make_hostile(prior.simulator, testing::Harm::nan, 0.2);
  for (const char* name : slider::kWithPrior) {
    const auto learner = builder(name)->build(setting(prior));
    const slider::History history = learn(*learner, 3);
    EXPECT_EQ(history.proposals[0].left_out_rows, 0);
    EXPECT_GT(history.proposals[2].left_out_rows, 0) << name;
    EXPECT_LT(history.proposals[2].left_out_rows, 24) << name;
  }
}

TEST(HostileSimulator, FailingInHalfItsRowsItEndsNoRun) {
  prior::Prior prior = slider::prior();
  prior.simulator = testing::make_hostile(prior.simulator, testing::Harm::exception, 0.5);
  for (const char* name : slider::kWithPrior) {
    const auto learner = builder(name)->build(setting(prior));
    EXPECT_EQ(learn(*learner, 3).returns.size(), 3u) << name;
  }
}

TEST(HostileSimulator, AlwaysFailingItEndsNoRun) {
  prior::Prior prior = slider::prior();
  prior.simulator = testing::make_hostile(prior.simulator, testing::Harm::nan, 1);
  for (const char* name : slider::kWithPrior) {
    const auto learner = builder(name)->build(setting(prior));
    EXPECT_EQ(learn(*learner, 3).returns.size(), 3u) << name;
  }
}

}  // namespace
}  // namespace rehearse::learners::black_drops
