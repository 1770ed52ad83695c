#include "rehearse/learners/black_drops/black_drops.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/testing/check_learner.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

using slider::builder;
using slider::learn;
using slider::run_trial;
using slider::setting;

TEST(BlackDrops, HasFourLearners) {
  std::vector<std::string> names;
  for (const auto& each : builders()) {
    names.push_back(each->name());
    EXPECT_FALSE(each->summary().empty());
    EXPECT_EQ(each->prior_use(), each->name() == "black-drops" ? PriorUse::none : PriorUse::required);
    EXPECT_EQ(each->chooses_priors(), each->name() == "gp-mi" || each->name() == "mi");
    EXPECT_TRUE(field_violations([&](FieldVisitor& v) { each->fields(v); }).empty());
  }
  EXPECT_EQ(names, std::vector<std::string>(std::begin(slider::kNames), std::end(slider::kNames)));
}

TEST(BlackDrops, BeginsWithNoPolicyOutsideOfItsBox) {
  Setting far = setting();
  far.start = Vector::Constant(far.policy->parameters(), 7.5);
  const auto learner = builder("black-drops");
  EXPECT_THROW((void)learner->build(far), InvalidInput);
  EXPECT_TRUE(set_field([&](FieldVisitor& v) { learner->fields(v); }, "search.box", "7.5"));
  EXPECT_NO_THROW((void)learner->build(far));
}

class EachLearner : public ::testing::TestWithParam<const char*> {};

TEST_P(EachLearner, KeepsTheLaws) {
  EXPECT_EQ(testing::check_learner(*builder(GetParam()), setting(), run_trial), std::vector<std::string>{});
}

// Seed 1. A policy that does nothing earns about 0; one that stops at 0 at once about 9. The prior's gain has the wrong
// sign: what is best for it drives the slider away.
TEST_P(EachLearner, LearnsTheSlider) {
  const auto learner = builder(GetParam(), "600")->build(setting(slider::prior(-1)));
  const slider::History history = learn(*learner, 4);
  EXPECT_GT(*std::max_element(history.returns.begin(), history.returns.end()), 7.5);
  EXPECT_GT(history.returns.back(), 7);
  if (std::string(GetParam()) != "black-drops") {
    EXPECT_LT(history.returns.front(), 1);
  }
}

TEST_P(EachLearner, AreNotAtTheBeginningWithLogs) {
  const auto alone = builder(GetParam())->build(setting()), with_log = builder(GetParam())->build(setting());
  const Proposal first = alone->ask();
  const Episode log = run_trial(first, 7);
  with_log->study({log});
  const Proposal& proposal = with_log->ask();
  ASSERT_TRUE(proposal.model);
  Matrix mean(1, log.states.cols()), variance(1, log.states.cols());
  proposal.model->predict(log.states.topRows(1), log.actions.topRows(1), mean, variance);
  EXPECT_NEAR(mean(0, 0), log.states(1, 0) - log.states(0, 0), 0.05) << "the model has not seen the log";
  EXPECT_NE(proposal.policy->name(), "schedule");
}

INSTANTIATE_TEST_SUITE_P(Names, EachLearner, ::testing::ValuesIn(slider::kNames), [](const auto& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// The learner of this name that is to learn the reward, too.
std::unique_ptr<LearnerBuilder> reward_builder(const std::string& name, const std::string& evaluations = "300") {
  auto learner = builder(name, evaluations);
  set_field([&](FieldVisitor& v) { learner->fields(v); }, "reward.learned", "true");
  return learner;
}

/// The setting without the reward; with `guess` a guess of it, twice as wide.
Setting without_reward(std::optional<prior::Prior> prior, bool guess) {
  Setting blind = setting(std::move(prior));
  if (guess)
    blind.task.initial_reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& X_next,
                                   VectorView rewards) { rewards = (-X_next.col(0).array().square() / 0.32).exp(); };
  blind.task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView) {
    ADD_FAILURE() << "the task's reward is not to be asked";
  };
  blind.task.solved = [](const Episode&) {
    ADD_FAILURE() << "nor whether the task is solved";
    return false;
  };
  return blind;
}

// Seeds 1 to 5. With a prior each of ten seeds measured earned 10; without one eight did, the others saw no reward in
// their random first trial.
TEST_P(EachLearner, LearnsTheRewardToo) {
  int learned = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Setting blind = without_reward(slider::prior(0.6), true);
    blind.seed = seed;
    const slider::History history = learn(*reward_builder(GetParam(), "600")->build(blind), 4);
    learned += *std::max_element(history.returns.begin(), history.returns.end()) > 7.5;
  }
  EXPECT_GE(learned, std::string(GetParam()) == "black-drops" ? 3 : 5);
}

TEST_P(EachLearner, KeepsTheLawsWithALearnedReward) {
  EXPECT_EQ(testing::check_learner(*reward_builder(GetParam()), without_reward(slider::prior(), true), run_trial),
            std::vector<std::string>{});
}

TEST_P(EachLearner, IsNotToldTheSuccessTestWhereItIsKeptFromIt) {
  const auto untold = builder(GetParam());
  EXPECT_TRUE(set_field([&](FieldVisitor& v) { untold->fields(v); }, "success_test", "false"));
  Setting blind = setting();
  blind.task.solved = [](const Episode&) {
    ADD_FAILURE() << "whether the task is solved is not to be asked";
    return false;
  };
  learn(*untold->build(blind), 2);
}

TEST(BlackDrops, ALearnedRewardNeedsAnInitialOneWithAPriorOnly) {
  for (const char* name : slider::kWithPrior) {
    const auto message = [&]() -> std::string {
      try {
        reward_builder(name)->build(without_reward(slider::prior(), false));
      } catch (const InvalidInput& error) {
        return error.what();
      }
      return {};
    }();
    for (const char* part : {"reward.learned = true", "initial_reward"})
      EXPECT_NE(message.find(part), std::string::npos) << name << ": " << message;
  }
  EXPECT_NO_THROW(reward_builder("black-drops")->build(without_reward({}, false)));
}

TEST(BlackDrops, RefusesARewardOfWholeEpisodesThatItCannotTake) {
  Setting whole = setting();
  whole.task.episode_reward = [](const Episode&) { return 1; };
  const auto learner = builder("black-drops");
  EXPECT_TRUE(learner->violations(whole.task, *whole.policy).empty());
  EXPECT_TRUE(set_field([&](FieldVisitor& v) { learner->fields(v); }, "search.method", "polish"));
  EXPECT_EQ(learner->violations(whole.task, *whole.policy).size(), 1U);
  EXPECT_EQ(reward_builder("black-drops")->violations(whole.task, *whole.policy).size(), 1U);
}

TEST(BlackDrops, TheFirstSearchOnAPriorUsesTheInitialReward) {
  const Proposal guessed = reward_builder("mi")->build(without_reward(slider::prior(), true))->ask();
  Setting told = setting();
  told.task.reward = without_reward({}, true).task.initial_reward;
  const Proposal proposal = builder("mi")->build(told)->ask();
  EXPECT_EQ(guessed.theta, proposal.theta);
  EXPECT_EQ(guessed.predicted_return, proposal.predicted_return);
}

TEST(BlackDrops, WithoutAPriorTheFirstTrialIsRandomAndReproducible) {
  for (const char* first_trial : {"extremes", "actions", "policy"}) {
    const auto first_theta = [&](std::uint64_t seed) {
      const auto with = builder("black-drops");
      EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, "first_trial.kind", first_trial));
      const Proposal proposal = with->build(setting({}, seed))->ask();
      EXPECT_EQ(proposal.policy->name(), std::string(first_trial) == "policy" ? "linear" : "schedule");
      EXPECT_EQ(proposal.rollouts, 0);
      EXPECT_FALSE(proposal.predicted_return || proposal.log_evidence || proposal.phi || proposal.model);
      return proposal.theta;
    };
    EXPECT_EQ(first_theta(1), first_theta(1));
    EXPECT_NE(first_theta(1), first_theta(2));
  }
}

TEST(BlackDrops, RandomActionsFillTheirBoundsAtEveryStep) {
  const Proposal proposal = builder("black-drops")->build(setting({}))->ask();
  const Matrix actions = run_trial(proposal, 1).actions;
  EXPECT_EQ(actions, proposal.theta);
  EXPECT_LE(actions.cwiseAbs().maxCoeff(), 1);
  EXPECT_LT(actions.minCoeff(), -0.3);
  EXPECT_GT(actions.maxCoeff(), 0.3);
}

TEST(BlackDrops, PromisesTheReturnOfATrialWhereItsSearchLooksFurther) {
  const auto learner = builder("mi");
  EXPECT_TRUE(set_field([&](FieldVisitor& v) { learner->fields(v); }, "search.extra_s", "1"));
  Setting alike = setting();
  alike.task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView rewards) {
    rewards.setOnes();
  };
  EXPECT_EQ(learner->build(alike)->ask().predicted_return, alike.task.horizon);
}

TEST(BlackDrops, WithoutAPriorIgnoresTheOneItIsGiven) {
  const auto with = builder("black-drops")->build(setting()), without = builder("black-drops")->build(setting({}));
  EXPECT_EQ(with->ask().theta, without->ask().theta);
}

TEST(BlackDrops, WithAPriorTheFirstTrialIsTheBestOnIt) {
  for (const char* name : slider::kWithPrior) {
    const auto learner = builder(name)->build(setting(slider::prior(1.5)));
    const Proposal& proposal = learner->ask();
    ASSERT_TRUE(proposal.predicted_return && proposal.phi && proposal.model);
    EXPECT_EQ(*proposal.phi, slider::prior(1.5).space.values());
    EXPECT_GE(proposal.rollouts, 250);
    EXPECT_FALSE(proposal.log_evidence.has_value());
    const double value = run_trial(proposal, 1).total_reward();
    EXPECT_GT(value, 7) << name;
    EXPECT_NEAR(value, *proposal.predicted_return, 1.5) << name;
  }
}

TEST(BlackDrops, IdentifiesThePriorsParametersAfterOneTrial) {
  for (const char* name : {"gp-mi", "mi"}) {
    const auto learner = builder(name)->build(setting());
    learner->tell(run_trial(learner->ask(), 1));
    const Proposal& second = learner->ask();
    EXPECT_LT((*second.phi - slider::kTruth).cwiseAbs().maxCoeff(), 0.02) << name;
    EXPECT_EQ(second.log_evidence.has_value(), std::string(name) == "gp-mi");
  }
}

TEST(BlackDrops, SavesThePolicyOfEveryTrial) {
  const auto learner = builder("black-drops")->build(setting());
  const slider::History history = learn(*learner, 3);
  const nlohmann::json policies = learner->save().at("policies");
  ASSERT_EQ(policies.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(policies[k].get<std::vector<double>>(),
              std::vector<double>(history.proposals[k].theta.begin(), history.proposals[k].theta.end()));
}

/// A learner told one episode, whose listener notes the phases and stops the search while `stop` is set.
struct Listened {
  std::vector<std::string> phases;
  bool stop = false;
  std::unique_ptr<Learner> learner;

  Listened() {
    Setting with_listener = setting();
    with_listener.progress = [this](const Progress& progress) {
      if (phases.empty() || phases.back() != progress.phase) phases.push_back(progress.phase);
      if (stop && progress.phase == "search") throw Interrupted{};
    };
    learner = builder("gp-mi")->build(with_listener);
    learner->tell(run_trial(learner->ask(), 1));
  }
};

TEST(BlackDrops, ReportsProgressAndCanBeInterrupted) {
  Listened interrupted;
  EXPECT_EQ(interrupted.phases, (std::vector<std::string>{"model", "search"}));
  interrupted.stop = true;
  EXPECT_THROW(interrupted.learner->ask(), Interrupted);
  interrupted.stop = false;
  EXPECT_GT(run_trial(interrupted.learner->ask(), 2).total_reward(), 7);
}

TEST(BlackDrops, AnInterruptedProposalLeavesNoTrace) {
  Listened interrupted, calm;
  const std::string saved = interrupted.learner->save().dump();
  interrupted.stop = true;
  EXPECT_THROW(interrupted.learner->ask(), Interrupted);
  EXPECT_EQ(interrupted.learner->save().dump(), saved);
  interrupted.stop = false;
  EXPECT_EQ(interrupted.learner->ask().theta, calm.learner->ask().theta);
}

TEST(BlackDrops, SaysEverythingThatIsWrongAtOnce) {
  Setting bad = setting({});
  bad.task.horizon = 0;
  bad.policy.reset();
  Options options;
  options.search.box = -1;
  try {
    make(bad, options);
    FAIL();
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    for (const char* part :
         {"search.box = -1, must be between 1e-06 and 1000000", "horizon = 0", "needs a prior", "needs a policy"})
      EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
}

TEST(BlackDrops, RefusesAStateThatDoesNotFitTheEpisodes) {
  const auto learner = builder("black-drops")->build(setting());
  const Episode episode = run_trial(learner->ask(), 1);
  learner->tell(episode);
  EXPECT_THROW(builder("black-drops")->build(setting())->load({episode, episode}, learner->save()), InvalidInput);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
