#include "rehearse/check/whole_turns.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace rehearse::check {
namespace {

/// A pendulum on a cart that earns what is given.
Task hanging(const std::function<double(double x, double theta)>& reward) {
  Task task;
  task.states = {{.name = "x"}, {.name = "theta", .kind = StateKind::angle}};
  task.actions = {{.name = "u"}};
  task.start_mean = Vector::Zero(2);
  task.horizon = 3;
  task.reward = [reward](const auto&, const auto&, const ConstMatrixView& next, VectorView rewards) {
    for (Index i = 0; i < next.rows(); ++i) rewards(i) = reward(next(i, 0), next(i, 1));
  };
  return task;
}

double height(double /*x*/, double theta) { return -std::cos(theta); }

TEST(WholeTurns, DoNotCountWhereCosinesDo) {
  Task task = hanging(height);
  task.solved = [](const Episode& episode) { return std::cos(episode.true_states(3, 1)) < -0.9; };
  task.ended = [](const ConstMatrixView& X, VectorView ended) { ended = X.col(0); };
  EXPECT_EQ(where_turns_count(task, 1), std::vector<std::string>{});
}

TEST(WholeTurns, CountInFormulasOfTheAngleItself) {
  Task task = hanging([](double x, double theta) { return x - std::abs(theta - std::numbers::pi); });
  task.solved = [](const Episode& episode) { return std::abs(episode.true_states(3, 1) - std::numbers::pi) < 0.17; };
  task.ended = each_state([](const ConstVectorView& state) { return state(1) > 4; });
  const std::vector<std::string> lines = where_turns_count(task, 1);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].find("the reward says something else when theta is a whole turn further"), 0u) << lines[0];
  EXPECT_EQ(lines[1].find("`ended` says"), 0u);
  EXPECT_EQ(lines[2].find("success says"), 0u);
}

TEST(WholeTurns, OfStatesThatAreNoAnglesAreNotTried) {
  Task task = hanging(height);
  task.states[1].kind = StateKind::plain;
  task.reward = [](const auto&, const auto&, const ConstMatrixView& next, VectorView rewards) {
    rewards = next.col(1);
  };
  EXPECT_EQ(where_turns_count(task, 1), std::vector<std::string>{});
}

}  // namespace
}  // namespace rehearse::check
