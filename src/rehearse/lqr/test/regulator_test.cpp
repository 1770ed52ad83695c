#include "rehearse/lqr/regulator.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "pendulum.hpp"

namespace rehearse::lqr {
namespace {

TEST(Regulator, SolvesTheRiccatiEquation) {
  // d' = 2 d + v: S = w + 4 S / (1 + S).
  const auto found = regulate({Matrix{{2}}, Matrix{{1}}}, Vector{{3}});
  ASSERT_TRUE(found);
  const double S = found->S(0, 0);
  EXPECT_NEAR(S, 3 + 4 * S / (1 + S), 1e-7);
  EXPECT_NEAR(found->gain(0, 0), -2 * S / (1 + S), 1e-9);
}

TEST(Regulator, MakesTheModelStable) {
  const Task task = upright::task(2, 0);
  const upright::Model model;
  const LinearSystem system = linear_system({model, task, serial_evaluator()}, Vector::Zero(2), Vector::Zero(1));
  EXPECT_TRUE(system.A.isApprox(Matrix{{1, line::kDt}, {line::kDt, 1}}, 1e-7)) << system.A;
  EXPECT_TRUE(system.B.isApprox(Matrix{{0}, {2 * line::kDt}}, 1e-7)) << "in units of half the action's range";
  const auto found = regulate(system, Vector{{1, 0.1}});
  ASSERT_TRUE(found);
  EXPECT_LT((system.A + system.B * found->gain).eigenvalues().cwiseAbs().maxCoeff(), 1);
}

TEST(Regulator, IsNotThereWhereActionsDoNothing) {
  EXPECT_FALSE(regulate({Matrix{{2}}, Matrix{{0}}}, Vector{{1}}));
  EXPECT_FALSE(regulate({Matrix{{kNaN}}, Matrix{{1}}}, Vector{{1}}));
}

}  // namespace
}  // namespace rehearse::lqr
