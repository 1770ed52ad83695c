#include "rehearse/check/differences.hpp"

#include <gtest/gtest.h>

namespace rehearse::check {
namespace {

constexpr double kNone = kNaN;

Task task_of(const std::vector<std::string>& states) {
  Task task;
  for (const std::string& name : states) {
    task.states.emplace_back();
    task.states.back().name = name;
  }
  return task;
}

TEST(Differences, NoPredictionIsInfinitelyFarFromOne) {
  const Matrix one{{1, kNone}, {kNone, 4}}, other{{1.5, kNone}, {3, 4}};
  EXPECT_EQ(apart(one, other), (Matrix{{0.5, 0}, {kInf, 0}}));
}

TEST(Differences, RoundingGrowsWithStatesAndChanges) {
  EXPECT_TRUE(rounding(Matrix{{1, -200}, {3, kNone}}, Matrix{{0, 5}, {-2, 0}})
                  .isApprox(Vector{{3e-14 + 2e-10, 200e-14 + 5e-10}}, 1e-12));
}

TEST(Differences, AreSaidOfTheFarthestState) {
  const Task task = task_of({"rate", "angle"});
  const Vector tolerated{{0.1, 0.1}};
  EXPECT_EQ(difference(task, Matrix{{0.1, 0}, {0, 0.1}}, tolerated), "");
  EXPECT_EQ(difference(task, Matrix{{0.2, 0.7}, {0, 0.1}, {0, 0.3}}, tolerated), "2 of 3 rows, angle by 0.7");
  EXPECT_EQ(difference(task, apart(Matrix{{kNone, 0}}, Matrix{{1, 0}}), tolerated),
            "1 of 1 rows, rate from a prediction to none");
  EXPECT_EQ(difference(task, Matrix(0, 2), tolerated), "");
}

TEST(Differences, NameTheFirstRowWithoutAPrediction) {
  Task task = task_of({"level"});
  task.actions = {{.name = "pump"}};
  const Matrix X{{0.5}, {-0.01}, {-1}}, U{{1}, {2}, {3}};
  EXPECT_EQ(without_prediction(task, X, U, Matrix{{1}, {2}, {3}}), "");
  EXPECT_EQ(without_prediction(task, X, U, Matrix{{1}, {kNone}, {kNone}}),
            "2 of 3 rows have no prediction; the first: level = -0.01, pump = 2");
}

TEST(Differences, OfAPriorThatKnowsLessThanThatNothingChangesAreSaid) {
  const Task task = task_of({"rate", "angle"});
  EXPECT_EQ(worse_than_nothing(task, Vector{{0.1, 0.1}}, Vector{{0, 0}}, Vector{{0.2, 0.09}}), "")
      << "noise may be all of it";
  EXPECT_EQ(worse_than_nothing(task, Vector{{0.1, 0.15}}, Vector{{0, 0}}, Vector{{0.2, 0.09}}),
            "it errs by more than a step changes angle: a sign, a unit, a delay, or what it lacks");
  EXPECT_EQ(worse_than_nothing(task, Vector{{0.3, 0.1}}, Vector{{0.1, 0}}, Vector{{0.2, 0.09}}),
            "its answers are nearer to the states that a step reaches than to their changes: it must give changes");
}

}  // namespace
}  // namespace rehearse::check
