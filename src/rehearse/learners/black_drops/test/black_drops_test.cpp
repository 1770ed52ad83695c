#include "rehearse/learners/black_drops/black_drops.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/testing/check_learner.hpp"
#include "rehearse/testing/hostile.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

using slider::builder;
using slider::History;
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

class EachLearner : public ::testing::TestWithParam<const char*> {};

TEST_P(EachLearner, KeepsTheLaws) {
  EXPECT_EQ(testing::check_learner(*builder(GetParam()), setting(), run_trial), std::vector<std::string>{});
}

// Seed 1. A policy that does nothing earns about 0; one that stops at 0 at once about 9. The prior's gain has the wrong
// sign: what is best for it drives the slider away.
TEST_P(EachLearner, LearnsTheSlider) {
  const auto learner = builder(GetParam(), "600")->build(setting(slider::prior(-1)));
  const History history = learn(*learner, 4);
  EXPECT_GT(*std::max_element(history.returns.begin(), history.returns.end()), 7.5);
  EXPECT_GT(history.returns.back(), 7);
  if (std::string(GetParam()) != "black-drops") {
    EXPECT_LT(history.returns.front(), 1);
  }
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

/// Without the reward; a guess of it, twice as wide, where there is one.
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
    const History history = learn(*reward_builder(GetParam(), "600")->build(blind), 4);
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

/// The slider's policy, with an example that earns much.
class PolicyWithExample final : public policy::Policy {
 public:
  std::string name() const override { return policy_->name(); }
  Index parameters() const override { return policy_->parameters(); }
  Index actions() const override { return policy_->actions(); }
  Matrix examples() const override { return Matrix{{-5, 0}}; }
  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double t_s, MatrixView U) const override {
    policy_->act(Theta, X, t_s, U);
  }

 private:
  std::shared_ptr<const policy::Policy> policy_ = slider::policy();
};

// The first descent begins at the example, or at a random point, and is cut off before it gets anywhere else.
TEST(BlackDrops, StartsFromThePolicysExamplesUnlessToldNotTo) {
  const auto first = [](const char* from_examples) {
    const auto with = builder("mi", "64");
    for (const auto& [name, value] : std::map<std::string, std::string>{{"start_from_examples", from_examples},
                                                                        {"search.race.descents", "1"},
                                                                        {"search.race.start_sigma", "1e-6"},
                                                                        {"search.race.sigma", "1e-6"},
                                                                        {"retry.searches", "0"}})
      EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, name, value));
    Setting own = setting();
    own.policy = std::make_shared<PolicyWithExample>();
    return with->build(own)->ask().theta;
  };
  EXPECT_LT((first("true") - Vector{{-5, 0}}).norm(), 1e-3);
  EXPECT_GT((first("false") - Vector{{-5, 0}}).norm(), 1e-2);
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

// With a gain that no search can reach, each is followed by one in the mean predictions.
TEST(BlackDrops, ExploresWhereASearchLeadsNoFurther) {
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
TEST(BlackDrops, SearchesInTheMeanPredictionsFirst) {
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

/// Trials 1 and 2 of a learner whose model is sure, on a task that asks for a last position in an interval.
std::vector<Proposal> surely(Interval last, const char* searches) {
  const auto with = builder("mi", "100");
  EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, "retry.searches", searches));
  Setting task = setting();
  task.task.solved = [last](const Episode& e) {
    const double position = e.true_states(e.steps(), 0);
    return position > last.low && position < last.high;
  };
  const auto learner = with->build(task);
  std::vector<Proposal> proposals = {learner->ask()};
  learner->tell(run_trial(proposals.front(), 1));
  proposals.push_back(learner->ask());
  return proposals;
}

double last_position(const Proposal& proposal) {
  return rollout::simulate_recorded({*proposal.model, *proposal.policy, slider::task(), {}, {.sample = false}},
                                    proposal.theta, 1)
      .states.back()(0, 0);
}

// The highest return is that of a slider at 0; descents that were given up end elsewhere.
TEST(BlackDrops, PrefersPoliciesThatAreExpectedToSolveTheTask) {
  const Interval beside = {0.1, 2}, nowhere = {9, 10};
  const auto careless = surely(beside, "0"), retrying = surely(beside, "3");
  const auto in_vain = surely(nowhere, "3"), content = surely({-1, 1}, "3");
  for (std::size_t trial : {0, 1}) {
    EXPECT_LT(last_position(careless[trial]), beside.low);
    EXPECT_GT(last_position(retrying[trial]), beside.low);
    EXPECT_LT(last_position(retrying[trial]), beside.high);
    EXPECT_GT(in_vain[trial].rollouts, 3 * careless[trial].rollouts) << "four searches";
    EXPECT_GE(*in_vain[trial].predicted_return, *careless[trial].predicted_return);
    EXPECT_LT(content[trial].rollouts, 1.5 * careless[trial].rollouts) << "one";
  }
}

TEST(BlackDrops, PrefersThemWithinAToleranceWhereTheModelIsUncertain) {
  const auto second = [](const char* tolerance) {
    const auto with = builder("black-drops-prior", "100");
    for (const auto& [name, value] : std::map<std::string, std::string>{
             {"mean_search.policies", "0"}, {"explore.gain", "0"}, {"retry.uncertain_tolerance", tolerance}})
      EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, name, value));
    Setting task = setting(slider::prior(1.5));
    task.task.solved = [](const Episode& e) { return e.true_states(e.steps(), 0) > 0.1; };
    const auto learner = with->build(task);
    learner->tell(run_trial(learner->ask(), 1));
    return learner->ask();
  };
  const Proposal careless = second("0"), strict = second("1e-9"), lenient = second("1e12");
  EXPECT_LT(last_position(careless), 0.1);
  EXPECT_LT(last_position(strict), 0.1);
  EXPECT_GE(*strict.predicted_return, *careless.predicted_return);
  EXPECT_GT(strict.rollouts, careless.rollouts + 100) << "it went on";
  EXPECT_GT(last_position(lenient), 0.1);
  EXPECT_LT(*lenient.predicted_return, *careless.predicted_return);
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

// Failures are drawn by a hash of the row: nothing is left to chance but the seed. 1000 rollouts of 12 rows each, of
// which 0.1 % are spoilt: 12 failures are expected, none has probability 6e-6.
TEST(BlackDrops, AHostileSimulatorEndsNoRun) {
  for (const char* name : slider::kWithPrior) {
    for (const auto harm : {testing::Harm::nan, testing::Harm::huge, testing::Harm::exception}) {
      prior::Prior prior = slider::prior();
      prior.simulator = testing::make_hostile(prior.simulator, harm, 0.001);
      const auto learner = builder(name, "1000")->build(setting(prior));
      const History history = learn(*learner, 3);
      EXPECT_GT(history.proposals[0].failed_rollouts, 0) << name;
      EXPECT_LT(history.proposals[0].failed_rollouts, 60) << name;
      for (const Proposal& proposal : history.proposals) EXPECT_TRUE(std::isfinite(*proposal.predicted_return));
      EXPECT_GT(history.returns.back(), 7) << name;
    }
  }
}

TEST(BlackDrops, TrainingRowsThatFailAreCounted) {
  prior::Prior prior = slider::prior();
  prior.simulator = testing::make_hostile(prior.simulator, testing::Harm::nan, 0.2);
  for (const char* name : slider::kWithPrior) {
    const auto learner = builder(name)->build(setting(prior));
    const History history = learn(*learner, 3);
    EXPECT_EQ(history.proposals[0].left_out_rows, 0);
    EXPECT_GT(history.proposals[2].left_out_rows, 0) << name;
    EXPECT_LT(history.proposals[2].left_out_rows, 24) << name;
  }
}

TEST(BlackDrops, ASimulatorThatFailsInHalfItsRowsEndsNoRun) {
  prior::Prior prior = slider::prior();
  prior.simulator = testing::make_hostile(prior.simulator, testing::Harm::exception, 0.5);
  for (const char* name : slider::kWithPrior) {
    const auto learner = builder(name)->build(setting(prior));
    EXPECT_EQ(learn(*learner, 3).returns.size(), 3u) << name;
  }
}

TEST(BlackDrops, ASimulatorThatAlwaysFailsEndsNoRun) {
  prior::Prior prior = slider::prior();
  prior.simulator = testing::make_hostile(prior.simulator, testing::Harm::nan, 1);
  for (const char* name : slider::kWithPrior) {
    const auto learner = builder(name)->build(setting(prior));
    EXPECT_EQ(learn(*learner, 3).returns.size(), 3u) << name;
  }
}

TEST(BlackDrops, SavesThePolicyOfEveryTrial) {
  const auto learner = builder("black-drops")->build(setting());
  const History history = learn(*learner, 3);
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
