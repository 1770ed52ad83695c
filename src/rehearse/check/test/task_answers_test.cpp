#include "rehearse/check/task_answers.hpp"

#include <gtest/gtest.h>

namespace rehearse::check {
namespace {

Task pushed() {
  Task task;
  task.states = {{"x", "m"}};
  task.actions = {{"u", "N", {-1, 1}}};
  task.horizon = 3;
  task.reward = [](const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& X_next,
                   VectorView rewards) { rewards = X.col(0) + 10 * U.col(0) + 100 * X_next.col(0); };
  return task;
}

TEST(TaskAnswers, AreTheRewardsAndWhereEpisodesEnd) {
  Task task = pushed();
  ASSERT_EQ(answers_of(task).size(), 1u) << "nothing ends an episode";
  task.ended = [](const ConstMatrixView& X, VectorView ended) { ended = X.col(0); };
  const auto answers = answers_of(task);
  ASSERT_EQ(answers.size(), 2u);
  const Matrix X{{1}, {2}}, U{{3}, {4}}, next{{5}, {6}};
  Vector rewards(2), ended(2);
  answers[0].second(X, U, next, rewards);
  answers[1].second(X, U, next, ended);
  EXPECT_EQ(rewards, (Vector{{531, 642}}));
  EXPECT_EQ(ended, (Vector{{5, 6}})) << "of the states that were reached";
}

TEST(TaskAnswers, DifferByMoreThanAPartOfTheLargest) {
  const Vector one{{0, 999, kNaN}};
  EXPECT_FALSE(differ(one, Vector{{0.5, 999, kNaN}}, 1e-3));
  EXPECT_TRUE(differ(one, Vector{{1.5, 999, kNaN}}, 1e-3));
  EXPECT_TRUE(differ(one, Vector{{0, 999, 0}}, 1e-3)) << "a number is none of NaN's rounding";
}

TEST(TaskAnswers, ARestingEpisodeStaysForTheWholeHorizon) {
  const Episode episode = resting(pushed(), Vector{{2}});
  EXPECT_EQ(episode.steps(), 3);
  EXPECT_EQ(episode.true_states, Matrix::Constant(4, 1, 2));
  EXPECT_TRUE(episode.actions.isZero(0));
}

}  // namespace
}  // namespace rehearse::check
