#include "rehearse/robot_file/task.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "example.hpp"
#include "rehearse/robot_file/read.hpp"

namespace rehearse::robot_file {
namespace {

using example::kSwing, example::with;

double reward_at(const Task& task, double rate, double angle, double u = 0) {
  Vector rewards(1);
  const Matrix X{{rate, angle}};
  task.reward(X, Matrix{{u}}, X, rewards);
  return rewards(0);
}

Episode at_angle(double angle, Index steps = 20) {
  Episode episode;
  episode.states = episode.true_states = Matrix::Zero(steps + 1, 2);
  episode.true_states.col(1).setConstant(angle);
  episode.actions = Matrix::Zero(steps, 1);
  episode.rewards = Vector::Zero(steps);
  return episode;
}

TEST(RobotTask, RewardsAreHighNearTheGoal) {
  const Task task = make_task(read(kSwing, "swing.toml", example::no_files));
  EXPECT_EQ(reward_at(task, 3, 0), 1);
  const double d2 = std::pow(1 - std::cos(1), 2) + std::pow(std::sin(1), 2);
  EXPECT_NEAR(reward_at(task, 3, 1), std::exp(-d2 / (2 * 0.5 * 0.5)), 1e-14);
}

TEST(RobotTask, RewardsMayBeAnyFormulaOfStatesAndActions) {
  const Task task = make_task(
      read(with("distance = [\"1 - height\", \"sin(angle)\"]\nwidth = 0.5", "formula = \"height - 0.1 * u^2\""),
           "swing.toml", example::no_files));
  EXPECT_NEAR(reward_at(task, 0, 1, 2), std::cos(1) - 0.4, 1e-15);
}

TEST(RobotTask, IsSolvedWhereTheConditionHoldsAtTheEnd) {
  const Task task = make_task(read(kSwing, "swing.toml", example::no_files));
  EXPECT_TRUE(task.solved(at_angle(0.1)));
  EXPECT_FALSE(task.solved(at_angle(1)));
  EXPECT_FALSE(task.solved(at_angle(0.1, 19))) << "cut short";
  Episode late = at_angle(2);
  late.true_states.col(1).tail(3).setZero();
  EXPECT_TRUE(task.solved(late)) << "0.2 s are three states";
  late.true_states(18, 1) = 2;
  EXPECT_FALSE(task.solved(late));
}

TEST(RobotTask, EndsWhereAConditionHolds) {
  const Task task =
      make_task(read(with("dt_s = 0.1", "dt_s = 0.1\nended = \"abs(rate) > 5\""), "swing.toml", example::no_files));
  EXPECT_FALSE(holds(task.ended, Vector{{4, 0}}));
  EXPECT_TRUE(holds(task.ended, Vector{{-6, 0}}));
}

TEST(RobotTask, ConditionsMayUseTheLastCommand) {
  const std::string dt = "dt_s = 0.1", unit = "unit = \"N m\"";
  std::string text = with(unit, "remember = 1");
  text.replace(text.find(dt), dt.size(), dt + "\nended = \"abs(u_last) > 1.5\"");
  const Task task = make_task(read(text, "swing.toml", example::no_files));
  EXPECT_FALSE(holds(task.ended, Vector{{0, 0, 1}}));
  EXPECT_TRUE(holds(task.ended, Vector{{0, 0, -2}}));
}

TEST(RobotTask, LimitsAreConditionsOnStatesAndActions) {
  const Task task = make_task(read(kSwing + R"toml(
[[limit]]
keep = "abs(rate) < 5 && abs(u) <= 1.5"
[[limit]]
name = "height"
keep = "height > -2"
risk = 0.2
)toml",
                                   "swing.toml", example::no_files));
  ASSERT_EQ(task.limits.size(), 2u);
  EXPECT_EQ(task.limits[0].name, "abs(rate) < 5 && abs(u) <= 1.5") << "without a name it has that of its condition";
  EXPECT_EQ(task.limits[0].risk, 0.05);
  EXPECT_EQ(task.limits[1].name, "height");
  EXPECT_EQ(task.limits[1].risk, 0.2);
  const Matrix X_next{{4, 0}, {5, 0}, {4, 0}};
  Vector kept(3);
  const Matrix U{{1.5}, {0}, {1.6}};
  task.limits[0].holds({X_next, U, X_next, U}, kept);
  EXPECT_EQ(kept, (Vector{{1, 0, 0}}));
  EXPECT_TRUE(task.violations().empty());
}

TEST(RobotTask, LimitsSeeActionsBeforeAndTime) {
  const Task task =
      make_task(read(kSwing + "[[limit]]\nkeep = \"abs(u - u_before) < 1 + time\"\n", "swing.toml", example::no_files));
  const Matrix X = Matrix::Zero(3, 2), U{{1}, {2}, {3}}, before{{0.5}, {1}, {-1}};
  Vector kept(3);
  task.limits[0].holds({X, U, X, before}, kept);
  EXPECT_EQ(kept, (Vector{{1, 0, 0}}));
  task.limits[0].holds({X, U, X, before, 2}, kept);
  EXPECT_EQ(kept, (Vector{{1, 1, 0}}));
}

TEST(RobotTask, DefinitionsOfActionsBeforeAreForCostsAndLimits) {
  const std::string define = "[define]";
  std::string text = kSwing + "[[limit]]\nkeep = \"jerk < 1\"\n";
  text.replace(text.find(define), define.size(), define + "\njerk = \"abs(u - u_before)\"");
  const Task task = make_task(read(text, "swing.toml", example::no_files));
  const Matrix X = Matrix::Zero(2, 2), U{{1}, {2}}, before{{0.5}, {0.5}};
  Vector kept(2);
  task.limits[0].holds({X, U, X, before}, kept);
  EXPECT_EQ(kept, (Vector{{1, 0}}));
  text.replace(text.find("height > 0.9"), 12, "jerk < 0.1");
  EXPECT_NE(example::complaint_of(text).find("success.when: 'u', which the definition of 'jerk' uses, is an action"),
            std::string::npos)
      << example::complaint_of(text);
}

TEST(RobotTask, BodiesAreDrawn) {
  EXPECT_FALSE(make_drawing(read(kSwing, "swing.toml", example::no_files)));
  const auto drawing =
      make_drawing(read(kSwing + "[[body]]\nname = \"rod\"\nfrom = [0, 0]\nto = [\"-sin(angle)\", \"height\"]\n",
                        "swing.toml", example::no_files));
  ASSERT_TRUE(drawing);
  const auto lines = std::get<scenario::LineDrawing>(*drawing).lines(Vector{{0, 0.3}});
  EXPECT_NEAR(lines[0].to.x(), -std::sin(0.3), 1e-15);
  EXPECT_NEAR(lines[0].to.y(), std::cos(0.3), 1e-15);
}

TEST(RobotTask, ACostSeesActionsBeforeAndTime) {
  const Task task = make_task(read(with("width = 0.5", "width = 0.5\ncost = \"2 * (u - u_before)^2 + height * time\""),
                                   "swing.toml", example::no_files));
  ASSERT_TRUE(task.cost);
  const Matrix X = Matrix::Zero(2, 2), next{{0, 0.3}, {1, 2}}, U{{1}, {2}}, before{{0.5}, {-1}};
  Vector costs(2);
  task.cost({X, U, next, before, 3}, costs);
  EXPECT_NEAR(costs(0), 2 * 0.25 + std::cos(0.3) * 3, 1e-12);
  EXPECT_NEAR(costs(1), 2 * 9 + std::cos(2.0) * 3, 1e-12);
  EXPECT_FALSE(make_task(read(kSwing, "swing.toml", example::no_files)).cost);
  EXPECT_NE(example::complaint_of(with("width = 0.5", "width = 0.5\ncost = \"u_befor\"")).find("'u_before'"),
            std::string::npos);
}

}  // namespace
}  // namespace rehearse::robot_file
