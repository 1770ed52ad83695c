#include "rehearse/check/row_laws.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse::check {
namespace {

const Matrix kStates{{1, 2}, {3, 4}, {5, 6}, {7, 8}};
const Matrix kActions{{0.1}, {0.2}, {0.3}, {0.4}};

std::vector<std::string> broken(const Reward& reward, std::vector<Limit> limits = {}, StateCondition ended = {}) {
  Task task;
  task.reward = reward;
  task.limits = std::move(limits);
  task.ended = std::move(ended);
  return broken_row_laws(task, kStates, kActions, 0.1 * kStates);
}

void rows_alone(const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& next, VectorView rewards) {
  rewards = next.col(0) - X.col(1) + U.col(0);
}

TEST(RowLaws, HoldWhereEachRowStandsForItself) {
  const Limit near{.name = "near", .text = {}, .holds = [](const Steps& s, VectorView kept) {
                     kept = (s.X.col(0).array() < 4).cast<double>();
                   }};
  EXPECT_EQ(broken(rows_alone, {near}, [](const ConstMatrixView& X, VectorView holds) { holds = X.col(0); }),
            std::vector<std::string>{});
  EXPECT_EQ(elsewhere(kActions), (Matrix{{0.4}, {0.3}}));
  EXPECT_EQ(broken_row_laws({}, Matrix(0, 2), Matrix(0, 1), Matrix(0, 2)), std::vector<std::string>{});
}

TEST(RowLaws, ARewardMustNotKnowTheOtherRows) {
  const auto of_largest = [](const auto& X, const auto&, const auto&, VectorView rewards) {
    rewards = X.col(0) / X.col(0).minCoeff();
  };
  ASSERT_EQ(broken(of_largest).size(), 1u);
  EXPECT_EQ(broken(of_largest)[0].find("the reward answers something else of the same steps in another batch"), 0u);
}

TEST(RowLaws, AnswersMustRepeat) {
  Rng noise({.seed = 1});
  const auto random = [&](const Steps&, VectorView kept) {
    for (double& value : kept) value = noise.uniform(0.1, 1);
  };
  const auto found = broken(rows_alone, {{.name = "near", .text = {}, .holds = random}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].find("limit near answers something else of the same steps a second time"), 0u);
}

TEST(RowLaws, AnEndMustNotKnowTheOtherRows) {
  const auto first = [](const ConstMatrixView&, VectorView holds) {
    holds.setZero();
    holds(0) = 1;
  };
  const auto found = broken(rows_alone, {}, first);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].find("`ended` answers something else of the same steps in another batch"), 0u);
}

}  // namespace
}  // namespace rehearse::check
