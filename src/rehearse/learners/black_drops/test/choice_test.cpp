#include "rehearse/learners/black_drops/choice.hpp"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/rollout/simulate.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

using slider::builder, slider::run_trial, slider::setting;

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
TEST(Choice, PrefersPoliciesThatAreExpectedToSolveTheTask) {
  const Interval beside = {0.1, 2}, nowhere = {9, 10};
  const auto careless = surely(beside, "0"), retrying = surely(beside, "3");
  const auto in_vain = surely(nowhere, "3"), content = surely({-1, 1}, "3");
  for (std::size_t trial : {0, 1}) {
    EXPECT_LT(last_position(careless[trial]), beside.low);
    EXPECT_GT(last_position(retrying[trial]), beside.low);
    EXPECT_LT(last_position(retrying[trial]), beside.high);
    EXPECT_GT(in_vain[trial].rollouts, 3 * careless[trial].rollouts) << "four searches";
    EXPECT_GE(*in_vain[trial].predicted_return, *careless[trial].predicted_return - (trial == 0 ? 0 : 0.05))
        << "the second search starts elsewhere, since the first trial was another";
    EXPECT_LT(content[trial].rollouts, 1.5 * careless[trial].rollouts) << "one";
  }
}

/// The first search of a trial and its choice, on the slider itself. variance: of predictions. told: the task has a
/// test of success, which nothing passes.
struct FirstSearch {
  FirstSearch(double variance, Index evaluations, bool told = false, std::uint64_t seed = 1, Index descents = 2)
      : model{slider::prior(), slider::kTruth, variance}, trial{.seed = seed, .trial = 2} {
    if (told) task.solved = [](const Episode&) { return false; };
    options.race.descents = descents;
    options.race.max_evaluations = evaluations;
    options.race.cmaes.population = 4;
    found = searches.search({}, 0);
    choice.take(found);
  }
  const dynamics::SimulatorModel model;
  const std::shared_ptr<const policy::Policy> policy = slider::policy();
  Task task = slider::task();
  const ProgressSink nobody;
  const StreamKey trial;
  SearchOptions options{.selection = 10};
  const SearchProblem problem{model, *policy, task, serial_evaluator(), nobody};
  TrialSearches searches{problem, options, trial};
  SearchResult found;
  Choice choice;
};

/// The worth of further searches after a first one.
struct FoundAgain {
  FoundAgain(double variance, Index evaluations, Index further, bool told = false, std::uint64_t seed = 1) {
    FirstSearch first(variance, evaluations, told, seed);
    Retry retry;
    retry.searches = further;
    prefer_found_again(first.searches, retry, first.choice);
    gain = first.choice.predicted_return - first.found.predicted_return;
    rollouts = static_cast<double>(first.searches.rollouts()) / static_cast<double>(first.found.rollouts);
  }
  double gain = 0;      // of the predicted return, by the further searches
  double rollouts = 0;  // in units of those of the first search
};

TEST(Choice, WhereTheModelIsSureSearchesGoOnUntilTwoAgree) {
  const FoundAgain agreed(0, 2000, 3);
  EXPECT_NEAR(agreed.rollouts, 2, 0.3);
  EXPECT_GE(agreed.gain, 0);
  double gain = 0, rollouts = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const FoundAgain brief(0, 8, 3, false, seed);
    EXPECT_GE(brief.gain, 0);
    if (brief.gain > 0.1) {
      EXPECT_GT(brief.rollouts, 3) << "a higher return is no agreement, seed " << seed;
    }
    gain = std::max(gain, brief.gain), rollouts = std::max(rollouts, brief.rollouts);
  }
  EXPECT_GT(gain, 0.1);
  EXPECT_GT(rollouts, 4) << "some never agree";
}

TEST(Choice, NoSearchIsRepeatedForTheReturnWhereThatIsNoUse) {
  for (const FoundAgain& none : {FoundAgain(0.0004, 8, 3), FoundAgain(0, 8, 0), FoundAgain(0, 8, 3, true)}) {
    EXPECT_EQ(none.gain, 0);
    EXPECT_LT(none.rollouts, 2) << "the policy may be judged again";
  }
}

TEST(Choice, APolicyThatWasTriedMakesRoomForTheBestNewOne) {
  FirstSearch first(0.0004, 200, false, 1, 4);
  ASSERT_GE(first.found.runners_up.size(), 2U);
  const auto chosen = [&](const std::vector<Vector>& tried, Retry retry, double solving = 0) {
    Choice choice = first.choice;
    choice.solving = solving;
    prefer_new(first.searches, tried, first.found, retry, choice);
    return choice;
  };
  const Vector old = first.found.theta;
  const Retry any{.uncertain_tolerance = 1e9};
  const Choice second = chosen({old}, any);
  EXPECT_NE(second.theta, old);
  EXPECT_LE(second.predicted_return, first.choice.predicted_return);
  const Choice third = chosen({old, second.theta}, any);
  EXPECT_NE(third.theta, old);
  EXPECT_NE(third.theta, second.theta);
  EXPECT_LE(third.predicted_return, second.predicted_return) << "the best new one comes first";

  EXPECT_EQ(chosen({second.theta, {}}, any).theta, old) << "it is new";
  EXPECT_EQ(chosen({old}, any, 0.9).theta, old) << "it solves the task";
  EXPECT_EQ(chosen({old}, {.uncertain_tolerance = 0}).theta, old) << "as published";
  std::vector<Vector> all = first.found.runners_up;
  all.push_back(old);
  EXPECT_EQ(chosen(all, any).theta, old) << "none is new";
  const double loss = 1 - second.predicted_return / first.choice.predicted_return;
  EXPECT_EQ(chosen({old}, {.uncertain_tolerance = 0.9 * std::abs(loss)}).theta, old) << "the new one costs too much";
  EXPECT_EQ(chosen({old}, {.uncertain_tolerance = 1.1 * std::abs(loss)}).theta, second.theta);
}

TEST(Choice, WhereTheModelIsSureOfAPolicyThatWasTriedANewOneMayCostAnything) {
  FirstSearch first(0, 8, false, 1, 4);
  const Vector old = first.found.theta;
  Choice choice = first.choice;
  prefer_new(first.searches, {old}, first.found, {.uncertain_tolerance = 1e-9}, choice);
  EXPECT_NE(choice.theta, old);
  EXPECT_LT(choice.predicted_return, first.choice.predicted_return - 0.01);
}

TEST(Choice, PrefersThemWithinAToleranceWhereTheModelIsUncertain) {
  const auto second = [](const char* tolerance) {
    const auto with = builder("black-drops-prior", "100");
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, "retry.uncertain_tolerance", tolerance));
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

/// A slider that may not come nearer to its goal than to a position: the reward asks for what is forbidden.
Setting limited(double low) {
  Setting limited = setting(slider::prior(1.5));
  const auto holds = [low](const Steps& steps, VectorView kept) {
    kept = (steps.X_next.col(0).array() > low).cast<double>();
  };
  limited.task.limits = {{"end", "position > low", holds, 0.05}};
  return limited;
}

TEST(Choice, KeepsLimitsWhateverTheReward) {
  for (const char* name : slider::kWithPrior)
    for (const bool told : {false, true}) {
      Setting task = limited(0.3);
      if (told) task.task.solved = [](const Episode& e) { return e.steps() == 12 && e.true_states(12, 0) < 0.35; };
      const auto learner = builder(name)->build(task);
      for (std::uint64_t trial : {1, 2}) {
        const Proposal& proposal = learner->ask();
        ASSERT_EQ(proposal.risks.size(), 1u);
        EXPECT_LE(proposal.risks[0].broken, proposal.risks[0].episodes / 20) << name << " " << trial;
        EXPECT_GE(proposal.risks[0].episodes, 400);
        EXPECT_TRUE(proposal.notes.empty()) << proposal.notes.front();
        const Episode episode = run_trial(proposal, trial);
        EXPECT_GT(episode.true_states.col(0).minCoeff(), 0.3) << name << " " << trial;
        learner->tell(episode);
      }
    }
}

TEST(Choice, WhereNothingSafePromisesMoreRandomActionsAreTried) {
  const auto trials = [](const char* explore, const char* name = "black-drops") {
    const auto with = builder(name);
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, "search.safety.explore", explore));
    Setting task = limited(0.3);
    task.task.solved = [](const Episode&) { return false; };
    task.task.reward = [](const auto&, const auto&, const auto&, VectorView rewards) { rewards.setZero(); };
    const auto learner = with->build(task);
    return slider::learn(*learner, 3).proposals;
  };
  const auto is_random = [](const Proposal& p) { return p.policy->name() == "schedule"; };
  EXPECT_EQ(std::ranges::count_if(trials("false"), is_random), 1) << "the first";
  EXPECT_EQ(std::ranges::count_if(trials("true", "gp-mi"), is_random), 0) << "a prior: policies teach more";
  const auto exploring = trials("true");
  const auto random = std::find_if(exploring.begin() + 1, exploring.end(), is_random);
  ASSERT_NE(random, exploring.end());
  EXPECT_LE(random->risks.front().broken, 11);
  ASSERT_FALSE(random->notes.empty());
  EXPECT_NE(random->notes.back().find("safe random actions are tried"), std::string::npos);
}

TEST(Choice, SaysWhereNothingIsSafe) {
  const auto learner = builder("gp-mi", "100")->build(limited(2));
  const Proposal proposal = learner->ask();
  EXPECT_EQ(proposal.risks[0].broken, proposal.risks[0].episodes);
  ASSERT_FALSE(proposal.notes.empty());
  EXPECT_NE(proposal.notes.front().find("the safest policy found may not be safe enough: 9"), std::string::npos);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
