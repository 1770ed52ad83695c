#include "rehearse/learners/pilco/trials.hpp"

#include <gtest/gtest.h>

#include "learner.hpp"
#include "rehearse/testing/check_learner.hpp"

namespace rehearse::learners::pilco {
namespace {

using slider::builder, slider::learn, slider::run_trial, slider::setting;

TEST(Trials, BeginsAnewUntilATrialSolvesTheTask) {
  const auto rollouts = [](bool solved, const char* restarts) {
    Setting with = setting();
    with.task.solved = [=](const Episode&) { return solved; };
    const auto learner = builder({{"search.line_searches", "10"}, {"search.restarts", restarts}})->build(with);
    return learn(*learner, 2).proposals.back().rollouts;
  };
  EXPECT_GT(rollouts(false, "2"), 2 * rollouts(false, "0"));
  EXPECT_EQ(rollouts(true, "2"), rollouts(true, "0"));
}

TEST(Trials, BeginsAlwaysAnewWhereNothingSaysWhatIsSolved) {
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
TEST(Trials, WhatEarnedTheSameTwicePromisesNoMore) {
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

TEST(Trials, AnEpisodeThatWasCutShortSolvesNothing) {
  const auto rollouts = [](Index steps) {
    Setting with = setting();
    with.task.solved = [](const Episode&) { return true; };
    const auto learner = builder({{"search.line_searches", "10"}, {"search.restarts", "2"}})->build(with);
    Episode episode = run_trial(learner->ask(), 1);
    learner->tell(episode.part(0, std::min(steps, episode.steps())));
    return learner->ask().rollouts;
  };
  const Index whole = setting().task.horizon;
  EXPECT_GT(rollouts(whole - 1), rollouts(whole));
}

TEST(Trials, TheFirstTrialIsRandomActions) {
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
  EXPECT_EQ(held(0), held(held.size() / 5 - 1));
  EXPECT_NE(held(0), held(held.size() / 5)) << "one constant action shows little";
}

}  // namespace
}  // namespace rehearse::learners::pilco
