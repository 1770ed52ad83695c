#include "rehearse/experiment/policy_match.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment {
namespace {

/// The line's policy u = −x/2 + 0.1 on a walk, and what is said of its actions.
struct PolicyMatch : ::testing::Test {
  PolicyMatch() {
    episode.states = Matrix(13, 1);
    for (Index t = 0; t <= 12; ++t) episode.states(t, 0) = std::cos(0.4 * static_cast<double>(t));
    episode.actions = -0.5 * episode.states.topRows(12).array() + 0.1;
    episode.rewards = Vector::Zero(12);
    episode.true_states = episode.states;
  }
  static TrialRecord trial(Index number, const Vector& theta) {
    return {.trial = number, .policy = "line", .theta = theta};
  }
  std::string said(const std::vector<TrialRecord>& earlier = {}) const {
    const auto sentences = sentences_on_policy({episode, off}, scenario, asked, earlier);
    return sentences.empty() ? "" : sentences.front();
  }
  const scenario::Scenario scenario = resolve(fake::catalogue(), fake::line_spec(1)).scenario;
  const TrialRecord asked = trial(2, Vector{{-0.5, 0.1}});
  Episode episode;
  double off = 0;
};

TEST_F(PolicyMatch, OfThePolicyItselfSaysNothing) {
  EXPECT_EQ(said(), "");
  EXPECT_LT(deviations({episode}, scenario, asked)(0), 1e-12);
  episode.actions.array() += 0.015;  // of a range of 2
  EXPECT_EQ(said(), "") << "motors are not exact";
  EXPECT_NEAR(deviations({episode}, scenario, asked)(0), 0.015, 1e-12);
}

TEST_F(PolicyMatch, ALoopWithAClockOfItsOwnComputesActionsBetweenTheSteps) {
  const Vector x = episode.states.col(0);
  episode.actions.col(0) = -0.5 * (0.7 * x.head(12) + 0.3 * x.tail(12)).array() + 0.1;
  EXPECT_NE(said(), "") << "as if each row was computed in its own states";
  off = 0.3;
  EXPECT_EQ(said(), "");
  episode.actions *= -1;
  EXPECT_NE(said().find("if v has the other sign"), std::string::npos) << said();
}

TEST_F(PolicyMatch, AnEpisodeWithoutAStepFollowsNoPolicy) {
  EXPECT_LT(largest_deviation({episode}, scenario, asked), 1e-12);
  EXPECT_GT(largest_deviation({episode.part(0, 0)}, scenario, asked), 1);
}

TEST_F(PolicyMatch, NamesTheUnitThatExplainsTheActions) {
  episode.states *= 1000;
  EXPECT_NE(said().find("they are the policy's if a column is 'x [mm]'; `tell --undo`"), std::string::npos) << said();
}

TEST_F(PolicyMatch, NamesTheSignAndTheRowThatExplainTheActions) {
  const Episode plain = episode;
  episode.states *= -1;
  EXPECT_NE(said().find("if x has the other sign"), std::string::npos) << said();
  episode = plain;
  episode.actions *= -1;
  EXPECT_NE(said().find("if v has the other sign"), std::string::npos) << said();
  episode = plain;
  episode.actions.bottomRows(11) = Matrix(plain.actions.topRows(11));
  EXPECT_NE(said().find("if each row has the action of the row before"), std::string::npos) << said();
}

TEST_F(PolicyMatch, NamesTheRowWhereThePolicyBegins) {
  episode.actions.topRows(4).setZero();
  EXPECT_NE(said().find("they are the policy's if it begins at 0.4 s: the rows before are to be left out"),
            std::string::npos)
      << said();
}

TEST_F(PolicyMatch, NamesTheColumnsThatAreExchanged) {
  scenario::Scenario two = scenario;
  two.task.states.push_back({.name = "y"});  // of which the policy knows nothing
  Episode swapped = episode;
  swapped.states.conservativeResize(Eigen::NoChange, 2);
  swapped.states.col(1) = episode.states.col(0);
  swapped.states.col(0).setLinSpaced(-1, 1);
  const auto sentences = sentences_on_policy({swapped}, two, asked, {});
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_NE(sentences[0].find("they are the policy's if x and y are exchanged"), std::string::npos) << sentences[0];
}

TEST_F(PolicyMatch, NamesTheTrialWhosePolicyItIs) {
  episode.actions = (0.3 * episode.states.topRows(12)).eval();
  EXPECT_NE(said({trial(1, Vector{{0.3, 0}})}).find("they are those of the policy of trial 1"), std::string::npos);
}

TEST_F(PolicyMatch, ElseSaysWhatItMayBe) {
  episode.actions = (episode.actions.array() + 0.5).min(1);
  EXPECT_NE(said().find("another policy, a state of another unit or sign"), std::string::npos) << said();
  EXPECT_NE(said().find("takes a wrong file back"), std::string::npos) << "a quarter of the range";
  episode.actions.array() -= 0.4;
  EXPECT_EQ(said().find("takes a wrong file back"), std::string::npos);
}

}  // namespace
}  // namespace rehearse::experiment
