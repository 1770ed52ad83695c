#include "rehearse/learners/ite/ite.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/learners/ite/test/slider_setting.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/qd/archive_bytes.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"
#include "rehearse/testing/check_learner.hpp"

namespace rehearse::learners::ite {
namespace {

TEST(Ite, KeepsTheLaws) {
  EXPECT_EQ(testing::check_learner(*builder(), setting(), run_trial, 4), std::vector<std::string>{});
  const auto grid = builder({{"archive.kind", "grid"}, {"archive.bins", "9"}, {"adaptation.max_trials", "2"}});
  EXPECT_EQ(testing::check_learner(*grid, setting(), run_trial, 4), std::vector<std::string>{});
}

// Doing nothing earns 0.6; the best policies on the plant itself, whose gain is 0.6, some 7.
TEST(Ite, FindsAPolicyThatWorksOnTheSliderToo) {
  const auto [proposals, near] = slider::learn(*builder()->build(setting(1)), 4, run_trial);
  EXPECT_GT(near.front(), 6.5);
  EXPECT_EQ(proposals.front().rollouts, 2048);
  EXPECT_EQ(proposals[1].rollouts, 0);
  EXPECT_GT(*proposals.front().predicted_return, 8);
  EXPECT_TRUE(proposals.front().archive && proposals.front().model && proposals.front().phi);
  Setting pulls_away = setting(-0.5);
  pulls_away.seed = 5;  // of seeds 1 to 10 this one alone finds another way within ten trials
  const std::vector<double> wrong_way = slider::learn(*builder()->build(pulls_away), 10, run_trial).returns;
  EXPECT_LT(wrong_way.front(), 0.1) << "its prior pulls the other way";
  EXPECT_GT(*std::max_element(wrong_way.begin(), wrong_way.end()), 3);
}

TEST(Ite, TheFirstPolicyIsTheArchivesBest) {
  const Proposal first = builder()->build(setting())->ask();
  const qd::Search search = qd::from_bytes(*first.archive, "archive");
  const Index best = search.archive.best();
  EXPECT_EQ(first.theta, search.archive.solution(best));
  EXPECT_DOUBLE_EQ(*first.predicted_return, search.archive.performance(best));
  EXPECT_EQ(search.evaluations, 2048U);
  EXPECT_GT(search.archive.statistics().coverage, 0.1);
}

TEST(Ite, BeginsWithAPolicyOnlyWhereThatCanHaveAnEffect) {
  const auto why = [](const OptionTexts& options, double parameter) -> std::string {
    Setting with = setting();
    with.start = Vector::Constant(with.policy->parameters(), parameter);
    try {
      (void)builder(options)->build(with);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why({}, 0.5), "");
  EXPECT_NE(why({{"archive.search.examples", "0"}}, 0.5).find("archive.search.examples = 0, so that"),
            std::string::npos);
  EXPECT_NE(why({}, 1e5).find("archive.box: parameter 1 of the policy to begin with is 100000"), std::string::npos);
}

const Table& table(const std::vector<Table>& tables, const std::string& name) {
  return *std::find_if(tables.begin(), tables.end(), [&](const Table& table) { return table.name == name; });
}

TEST(Ite, TellsWhatTheArchivePromisesAndWhatIsExpectedNow) {
  Setting wrong_way = setting(-0.5);
  wrong_way.task.descriptor_names = {"half way [m]", "end [m]"};
  const auto learner = builder()->build(wrong_way);
  const Proposal first = learner->ask();
  const qd::Archive archive = qd::from_bytes(*first.archive, "archive").archive;
  const Episode episode = run_trial(first, 1);
  learner->tell(episode);
  const auto tables = learner->tables();
  const Table& elites = table(tables, "elites");
  EXPECT_EQ(elites.columns, (std::vector<std::string>{"half way [m]", "end [m]", "promised", "expected", "deviation"}));
  ASSERT_EQ(elites.rows.rows(), archive.size());
  const Index tried = archive.best();
  EXPECT_EQ(elites.rows.row(7).head(2), archive.descriptor(7).transpose());
  EXPECT_EQ(elites.rows(7, 2), archive.performance(7));
  EXPECT_EQ(table(tables, "tried").rows, (Matrix{{1, double(tried + 1), archive.performance(tried), 1}}));
  EXPECT_NEAR(elites.rows(tried, 3), episode.total_reward(), 0.01 * archive.performance(tried)) << "σ_n² = 0.001";
  EXPECT_LT(elites.rows(tried, 4), 0.05 * archive.performance(tried));
  const Proposal second = learner->ask();
  Index next = 0;
  (elites.rows.col(3) + 0.05 * elites.rows.col(4)).maxCoeff(&next);
  EXPECT_EQ(second.theta, archive.solution(next)) << "κ = 0.05";
  EXPECT_EQ(*second.predicted_return, elites.rows(next, 3));
}

TEST(Ite, TheTrialsAfterItStoppedTeachNothing) {
  const auto learner = builder({{"adaptation.stop_ratio", "0"}, {"adaptation.max_trials", "2"}})->build(setting(-0.5));
  slider::learn(*learner, 4, run_trial);
  const Table tried = table(learner->tables(), "tried");
  EXPECT_EQ(tried.rows.col(3), (Vector{{1, 1, 0, 0}}));
  EXPECT_EQ(tried.rows(2, 1), tried.rows(3, 1));
}

TEST(Ite, OnceItStopsTheBestPolicyIsRepeated) {
  const auto learner = builder({{"adaptation.stop_ratio", "0"}, {"adaptation.max_trials", "3"}})->build(setting(-0.5));
  const auto [proposals, returns] = slider::learn(*learner, 6, run_trial);
  const auto best = std::max_element(returns.begin(), returns.begin() + 3) - returns.begin();
  for (std::size_t trial = 3; trial < 6; ++trial)
    EXPECT_EQ(proposals[trial].theta, proposals[static_cast<std::size_t>(best)].theta);
  EXPECT_TRUE(proposals[2].notes.empty() && proposals[4].notes.empty());
  ASSERT_EQ(proposals[3].notes.size(), 1U);
  EXPECT_EQ(proposals[3].notes[0], "the best policy is tried again from now on: after trial 3: adaptation.max_trials");
}

/// The slider with `offset` more reward for each step; a task that charges `floor` for steps which a fall leaves out.
struct Shifted {
  double offset = 0, floor = 0;
  bool falls = false;  // in the end
  double gain = 1;     // of the prior

  Setting setting() const {
    Setting shifted = ite::setting(gain);
    shifted.task.reward_floor = floor;
    shifted.task.reward = [offset = offset](const ConstMatrixView& X, const ConstMatrixView& U,
                                            const ConstMatrixView& next, VectorView rewards) {
      slider::reward(X, U, next, rewards);
      rewards.array() += offset;
    };
    return shifted;
  }
  Episode trial(const Proposal& proposal) const {
    Episode episode = run_trial(proposal, 1);
    episode.rewards.array() += offset;
    episode.ended = falls;
    if (falls) episode.rewards(episode.steps() - 1) = -100;
    return episode;
  }
};

/// The notes after one trial: whether it stops, and why.
std::vector<std::string> notes_after_a_trial(const Shifted& how) {
  const auto learner = builder()->build(how.setting());
  learner->tell(how.trial(learner->ask()));
  return learner->ask().notes;
}

// A prior that pulls the other way: the first trial earns less than 0.1 of the 8 that are promised.
TEST(Ite, StopsByTheReturnItselfWhateverFailingCosts) {
  EXPECT_TRUE(notes_after_a_trial({.gain = -0.5}).empty());
  EXPECT_TRUE(notes_after_a_trial({.floor = -100, .gain = -0.5}).empty());
  EXPECT_FALSE(notes_after_a_trial({.offset = 10, .gain = -0.5}).empty())
      << "10 a step are earned by doing nothing, too";
  EXPECT_TRUE(notes_after_a_trial({.offset = -10, .floor = -100, .gain = -0.5}).empty())
      << "nothing above 0 is promised";
}

TEST(Ite, AFallScoresNothingAndIsNotRepeated) {
  const auto expected = [](const Shifted& how) {
    const auto learner = builder()->build(how.setting());
    const Episode episode = how.trial(learner->ask());
    learner->tell(episode);
    const auto tables = learner->tables();
    const auto tried = static_cast<Index>(table(tables, "tried").rows(0, 1)) - 1;
    return std::pair(table(tables, "elites").rows(tried, 3), episode.total_reward());
  };
  const auto [walks, earned] = expected({});
  EXPECT_NEAR(walks, earned, 0.02);
  EXPECT_NEAR(expected({.falls = true}).first, 0, 0.02) << "and not −90";
  const auto [negative, lost] = expected({.offset = -10, .floor = -20, .falls = true});
  EXPECT_NEAR(negative, lost, 0.02 * 240) << "where all returns are negative a fall is what it costs";

  const auto learner = builder({{"adaptation.stop_ratio", "0"}, {"adaptation.max_trials", "2"}})->build(setting());
  const Vector first = learner->ask().theta;
  learner->tell(Shifted{.falls = true}.trial(learner->ask()));
  const Vector second = learner->ask().theta;
  Episode backwards = run_trial(learner->ask(), 2);
  backwards.rewards.setConstant(-0.1);
  learner->tell(backwards);
  EXPECT_NE(first, second);
  EXPECT_EQ(learner->ask().theta, second) << "it earned less than the 0 that the fall scores, and more than the fall";
}

TEST(Ite, AnEpisodeThatWasCutShortTeachesNothing) {
  const Shifted negative{.offset = -10, .floor = -20};
  const auto learner = builder({{"adaptation.max_trials", "2"}})->build(negative.setting());
  std::vector<Vector> thetas;
  for (const Index missing : {0, 9, 0, 9}) {
    thetas.push_back(learner->ask().theta);
    const Episode episode = negative.trial(learner->ask());
    learner->tell(episode.part(0, episode.steps() - missing));
  }
  EXPECT_EQ(thetas[1], thetas[2]) << "it is tried again";
  EXPECT_EQ(table(learner->tables(), "tried").rows.col(3), (Vector{{1, 0, 1, 0}}));
  const Vector best = learner->ask().theta;
  EXPECT_TRUE(best == thetas[0] || best == thetas[2]);
}

TEST(Ite, RefusesToGoOnInAnotherArchive) {
  const std::string file = ::testing::TempDir() + "rehearse-other-archive.bin";
  const auto write = [&](std::uint64_t seed) {
    std::ofstream(file, std::ios::binary) << *builder()->build(setting(1, seed))->ask().archive;
  };
  write(1);
  const auto with_file = builder({{"archive.file", file}});
  const auto learner = with_file->build(setting());
  const std::vector<Episode> episodes{run_trial(learner->ask(), 1)};
  learner->tell(episodes.front());
  const auto state = learner->save();
  const auto resume = [&] {
    const auto resumed = with_file->build(setting());
    resumed->load(episodes, state);
    EXPECT_EQ(resumed->save(), state);
    return resumed->ask().theta;
  };
  EXPECT_EQ(resume(), learner->ask().theta);
  write(2);
  EXPECT_THROW(resume(), InvalidInput);
  std::filesystem::remove(file);
}

TEST(Ite, RefusesATaskThatDoesNotSayHowItWent) {
  Setting mute = setting();
  mute.task.descriptor = {};
  EXPECT_NE(refusal(mute).find("not a robot's file or one in Python"), std::string::npos) << refusal(mute);
  EXPECT_EQ(builder()->violations(mute.task, *mute.policy).size(), 1U);
  Setting limited = setting();
  limited.task.limits = {{"end", "", [](const Steps&, VectorView kept) { kept.setOnes(); }}};
  EXPECT_NE(refusal(limited).find("the task has limits, which ite does not keep"), std::string::npos);
  Setting unbounded = setting();
  unbounded.task.descriptor_bounds.clear();
  EXPECT_NE(refusal(unbounded).find("descriptor_bounds"), std::string::npos) << refusal(unbounded);
  Setting other = setting();
  other.task.descriptor_bounds.resize(1);
  EXPECT_EQ(refusal(other), "the task's descriptor has 2 numbers, its descriptor_bounds 1");
  Setting without = setting();
  without.prior.reset();
  EXPECT_EQ(refusal(without), "this learner needs a prior");
}

TEST(Ite, TakesThePendubot) {
  const scenario::Scenario pendubot = robots::pendubot::make({});
  EXPECT_EQ(builder()->violations(pendubot.task, *pendubot.policy), std::vector<std::string>{});
  EXPECT_EQ(builder({{"archive.kind", "grid"}, {"archive.bins", "30"}})->violations(pendubot.task, *pendubot.policy),
            std::vector<std::string>{"archive.bins = 30 of 6 descriptors are 7.29e+08 niches, must be ≤ 1e+08"});
  Setting setting{.task = pendubot.task, .policy = pendubot.policy};
  setting.prior = prior::Prior{"useful", pendubot.priors[0].simulator, pendubot.priors[0].parameters};
  const Proposal first = builder({{"archive.evaluations", "500"}})->build(setting)->ask();
  EXPECT_EQ(first.theta.size(), 81);
  EXPECT_EQ(first.failed_rollouts, 0);
}

}  // namespace
}  // namespace rehearse::learners::ite
