#include "rehearse/learners/black_drops/trial_search.hpp"

#include <algorithm>
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

// The prior is taken at its word, so that returns on it are exact.
TEST(TrialSearch, LooksFurtherForAPolicyThatLasts) {
  Setting brief = setting(slider::prior());
  brief.task.horizon = 4;
  brief.task.start_std.setZero();
  const auto proposal = [&](const char* extra_s) {
    const auto with = builder("mi", "100");
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, "search.extra_s", extra_s));
    return with->build(brief)->ask();
  };
  const Proposal alone = proposal("0"), lasting = proposal("4");
  const auto value = [&](const Proposal& of, Index steps) {
    Task task = brief.task;
    task.horizon = steps;
    return rollout::simulate_recorded({*of.model, *of.policy, task, {}}, of.theta, 1).returns(0);
  };
  EXPECT_NEAR(*lasting.predicted_return, value(lasting, 4), 1e-12) << "of the trial";
  EXPECT_GE(value(lasting, 4), 0.94 * value(alone, 4)) << "as good in the trial, but for retry.tolerance";
  EXPECT_GE(value(lasting, 24), value(alone, 24));
  EXPECT_GT(lasting.rollouts, alone.rollouts + 50);
}

TEST(TrialSearch, SaysWhereNoPolicySolvesTheTask) {
  const auto is_said = [](const char* name, double goal, bool logs) {
    Setting with = setting();
    with.task.solved = [goal](const Episode& episode) { return episode.states(episode.steps(), 0) < goal; };
    const auto learner = builder(name, "100")->build(with);
    if (logs) learner->tell(run_trial(learner->ask(), 1));
    const std::vector<std::string> notes = learner->ask().notes;
    return std::ranges::find(notes, kNoneSolves) != notes.end();
  };
  for (const bool logs : {false, true})
    for (const char* name : slider::kWithPrior) {
      EXPECT_FALSE(is_said(name, 0.2, logs)) << name;
      EXPECT_TRUE(is_said(name, -100, logs)) << name;
    }
}

}  // namespace
}  // namespace rehearse::learners::black_drops
