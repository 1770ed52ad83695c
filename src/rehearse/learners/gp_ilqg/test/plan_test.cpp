#include "rehearse/learners/gp_ilqg/plan.hpp"

#include <gtest/gtest.h>

#include "rehearse/lqr/hold.hpp"
#include "rehearse/lqr/test/line.hpp"

namespace rehearse::learners::gp_ilqg {
namespace {

std::vector<policy::FeedbackStage> idle(const Task& task) {
  return policy::open_loop(task, Matrix::Zero(task.horizon, task.action_size()));
}

/// Gains of the line's plan by Riccati's recursion in plain numbers, the first step's first.
std::vector<Matrix> riccati(const Task& task) {
  const double half = task.actions[0].bounds.high;
  const Matrix A{{1, lqr::line::kDt}, {0, 1}}, B{{0}, {lqr::line::kDt}}, Q = Vector{{2, 0.2}}.asDiagonal();
  const double r = 2 * lqr::line::kActionCost / (half * half);
  Matrix S = Matrix::Zero(2, 2);
  std::vector<Matrix> gains(static_cast<std::size_t>(task.horizon));
  for (std::size_t t = gains.size(); t-- > 0;) {
    const Matrix all = S + Q;
    gains[t] = -(B.transpose() * all * A) / ((B.transpose() * all * B)(0, 0) + r);
    S = A.transpose() * all * (A + B * gains[t]);
  }
  return gains;
}

TEST(Plan, OfLinearStepsAndAQuadraticRewardIsTheRegulator) {
  const Task task = lqr::line::task();
  const lqr::line::Model model;
  const lqr::Problem problem{model, task, serial_evaluator()};
  const Plan plan = improve(problem, {.cost = {.action_cost = lqr::line::kActionCost}}, idle(task));
  const auto gains = riccati(task);
  for (std::size_t t = 0; t < gains.size(); ++t) {
    EXPECT_TRUE(plan.stages[t].gain.isApprox(gains[t], 1e-3)) << t << ": " << plan.stages[t].gain << " " << gains[t];
    EXPECT_NEAR(plan.stages[t].action(0), (gains[t] * plan.stages[t].state)(0), 1e-3) << t;
  }
}

TEST(Plan, KeepsTheBoundsOfActions) {
  const Task task = lqr::line::task(1);
  const lqr::line::Model model;
  const Plan plan = improve({model, task, serial_evaluator()}, {.cost = {.action_cost = 1e-3}}, idle(task));
  EXPECT_NEAR(plan.stages.front().action(0), -1, 1e-6) << "full pull first";
  for (const auto& stage : plan.stages) EXPECT_LE(std::abs(stage.action(0)), 1 + 1e-12);
  EXPECT_NEAR(plan.states(plan.steps, 0), 0, 0.02);
}

TEST(Plan, AvoidsWhatTheModelDoesNotKnow) {
  const Task task = lqr::line::task();
  const lqr::line::Model unsure(0.3);
  const lqr::Problem problem{unsure, task, serial_evaluator()};
  const Plan bold = improve(problem, {.cost = {.action_cost = 0.5}, .uncertainty = 0}, idle(task));
  const Plan careful = improve(problem, {.cost = {.action_cost = 0.5}, .uncertainty = 1}, idle(task));
  EXPECT_LT(careful.states.col(0).squaredNorm(), bold.states.col(0).squaredNorm())
      << "far from 0 the variance is larger: it goes there sooner";
}

TEST(Plan, EndsWithAHold) {
  const Task task = lqr::line::task();
  const lqr::line::Model model;
  const lqr::Problem problem{model, task, serial_evaluator()};
  const lqr::StepCosts costs(task, {.scale = lqr::CostScale::linear, .action_cost = lqr::line::kActionCost});
  const auto hold = lqr::find_hold(problem, costs, Vector{{0.3, -0.2}}, Vector{{1}}, 0);
  ASSERT_TRUE(hold);
  EXPECT_NEAR(hold->stage.state.norm(), 0, 1e-5);
  Task longer = task;
  longer.horizon = 400;
  EXPECT_TRUE(hold->stage.gain.isApprox(riccati(longer).front(), 1e-3)) << hold->stage.gain;
  std::vector<policy::FeedbackStage> short_plan = idle(task);
  short_plan.resize(6);
  const Plan plan = improve(problem, {.cost = {.action_cost = lqr::line::kActionCost}}, short_plan, &*hold);
  EXPECT_TRUE(plan.stages[2].gain.isApprox(hold->stage.gain, 1e-3)) << "what follows is planned for";
  EXPECT_EQ(plan.stages.back().gain, hold->stage.gain);
}

TEST(Plan, ThatIsNotFiniteSaysSo) {
  Task task = lqr::line::task();
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView rewards) {
    rewards.setConstant(kNaN);
  };
  const lqr::line::Model model;
  EXPECT_EQ(improve({model, task, serial_evaluator()}, {}, idle(task)).cost, kInf);
}

}  // namespace
}  // namespace rehearse::learners::gp_ilqg
