#include "rehearse/learners/gp_ilqg/forward_pass.hpp"

#include <gtest/gtest.h>

#include "rehearse/lqr/test/line.hpp"

namespace rehearse::learners::gp_ilqg {
namespace {

/// Two plans of three steps that pull by so much.
std::vector<std::vector<policy::FeedbackStage>> pulls(const Task& task, double first, double second) {
  return {policy::open_loop(task, Matrix::Constant(3, 1, first)),
          policy::open_loop(task, Matrix::Constant(3, 1, second))};
}

TEST(ForwardPass, FollowsPlansInTheMean) {
  Task task = lqr::line::task();
  task.start_std = Vector::Ones(2);  // which plans do not know
  const lqr::line::Model model(0.5);
  const lqr::Problem problem{model, task, serial_evaluator()};
  const lqr::StepCosts costs(task, {.scale = lqr::CostScale::linear, .action_cost = 0.1});
  const auto both = ForwardPass(problem, costs, nullptr).follow(pulls(task, 0, 2));
  ASSERT_EQ(both[1].steps, 3);
  EXPECT_TRUE(both[0].states.isApprox(Matrix{{1, 0}, {1, 0}, {1, 0}, {1, 0}}));
  EXPECT_TRUE(both[1].states.isApprox(Matrix{{1, 0}, {1, 0.2}, {1.02, 0.4}, {1.06, 0.6}}));
  EXPECT_NEAR(both[0].cost, 3, 1e-12) << "of the planned steps";
  EXPECT_NEAR(both[0].promise, -30, 1e-9) << "if it could stay there";
}

TEST(ForwardPass, ChargesAnEarlyEndAndRefusesWhatIsNotFinite) {
  Task task = lqr::line::task();
  task.ended = each_state([](const ConstVectorView& state) { return state(1) > 0.15; });
  const lqr::line::Model model;
  const lqr::Problem problem{model, task, serial_evaluator()};
  const lqr::StepCosts costs(task, {.scale = lqr::CostScale::linear, .action_cost = 1e-9});
  const auto both = ForwardPass(problem, costs, nullptr).follow(pulls(task, 2, kNaN));
  EXPECT_EQ(both[0].steps, 1);
  EXPECT_NEAR(both[0].cost, 1 + 0.1 * 0.04 + 2 * 10, 1e-6);
  EXPECT_EQ(both[1].cost, kInf);
}

TEST(ForwardPass, AddsWhatFollowsTheHold) {
  const Task task = lqr::line::task();
  const lqr::line::Model model;
  const lqr::Problem problem{model, task, serial_evaluator()};
  const lqr::StepCosts costs(task, {.scale = lqr::CostScale::linear, .action_cost = 1e-9});
  const lqr::Hold hold{{Vector{{0}}, Vector{{0.5, 0}}, Matrix{{0, 0}}}, {Vector::Zero(2), Matrix{{8, 0}, {0, 0}}}};
  const auto both = ForwardPass(problem, costs, &hold).follow(pulls(task, 0, 0));
  EXPECT_NEAR(both[0].cost, 3 + 0.5 * 8 * 0.25, 1e-9);
}

}  // namespace
}  // namespace rehearse::learners::gp_ilqg
