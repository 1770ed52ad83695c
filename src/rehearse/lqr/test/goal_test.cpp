#include "rehearse/lqr/goal.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "pendulum.hpp"

namespace rehearse::lqr {
namespace {

const StreamKey kKey{.seed = 3, .stage = Stage::goal};

std::optional<policy::HandOver> goal(const Task& task, const dynamics::DynamicsModel& model = upright::Model()) {
  return find_goal({model, task, serial_evaluator()}, kKey);
}

/// It begins by hanging.
Task hanging(double bound, double where) {
  Task task = upright::task(bound, where);
  task.start_mean = Vector{{std::numbers::pi, 0}};
  return task;
}

TEST(Goal, IsWhereStayingEarnsMost) {
  const auto found = goal(hanging(2, 0));
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::remainder(found->feedback.state(0), 2 * std::numbers::pi), 0, 1e-4);
  EXPECT_NEAR(found->feedback.state(1), 0, 1e-5);
  EXPECT_LT(found->feedback.gain(0, 0), -1) << "more than what pulls it down";
}

TEST(Goal, MayNeedAnAction) {
  const auto found = goal(hanging(2, 0.5));
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::remainder(found->feedback.state(0), 2 * std::numbers::pi), 0.5, 5e-3);
  EXPECT_NEAR(found->feedback.action(0), -std::sin(0.5), 5e-3);
}

TEST(Goal, IsFoundFromTheStartWhereThereAreNoAngles) {
  Task task = line::task(1);
  task.horizon = 60;
  const auto found = goal(task, line::Model());
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->feedback.state.norm(), 0, 1e-5);
}

TEST(Goal, IsFoundWhereTurnsOfAJointCount) {
  Task task = hanging(2, 0);
  task.states[0].kind = StateKind::plain;
  task.states[0].unit = "rad";
  const auto found = goal(task);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->feedback.state(0), 0, 1e-4) << "where it begins it could stay, too";
}

TEST(Goal, IsNotThereWhereTheRobotCannotStay) {
  EXPECT_FALSE(goal(hanging(0.1, 1.2)));
  /// It falls for ever, whatever the action.
  class Falls final : public dynamics::DynamicsModel {
   public:
    void predict(const ConstMatrixView&, const ConstMatrixView&, MatrixView mean, MatrixView variance) const override {
      mean.setConstant(-1);
      variance.setZero();
    }
    bool certain() const override { return true; }
  };
  EXPECT_FALSE(goal(line::task(1), Falls()));
}

}  // namespace
}  // namespace rehearse::lqr
