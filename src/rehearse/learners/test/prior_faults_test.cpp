#include "rehearse/learners/prior_faults.hpp"

#include <utility>

#include <gtest/gtest.h>

namespace rehearse::learners {
namespace {

TEST(PriorFaults, AreOneRowThatFailedAndWhy) {
  Setting setting;
  EXPECT_EQ(fault_of_prior(setting), "") << "without a prior";
  setting.task.states = {{"v", "m/s"}, {"x", "m"}};
  setting.task.actions = {{"u", "N", {-1, 1}}};
  const auto fails = [](const auto& X, const auto&, const Vector&, MatrixView dX) {
    dX.setZero();
    if ((X.array() > 5).any()) throw std::runtime_error("no licence");
  };
  setting.prior = prior::Prior{"near", system::make_simulator({}, fails), {}};
  setting = watched(std::move(setting));
  const prior::Prior copy = *setting.prior;
  Matrix dX(2, 2);
  EXPECT_EQ(copy.mean(Matrix::Zero(2, 2), Matrix::Ones(2, 1), Vector(), dX), 0);
  EXPECT_EQ(fault_of_prior(setting), "");
  EXPECT_EQ(copy.mean(Matrix{{1, 2}, {1, 7}}, Matrix::Ones(2, 1), Vector(), dX), 1);
  EXPECT_EQ(fault_of_prior(setting), "in v = 1, x = 7 under u = 1: no licence");
  forget_faults(setting);
  EXPECT_EQ(fault_of_prior(setting), "");
}

TEST(PriorFaults, OfLargeRobotsNameTheFirstStates) {
  Setting setting;
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g", "h"}) setting.task.states.push_back({name, ""});
  setting.task.actions = {{"u", "N", {-1, 1}}};
  const auto blank = [](const auto&, const auto&, const Vector&, MatrixView dX) { dX.setConstant(kNaN); };
  setting.prior = prior::Prior{"near", system::make_simulator({}, blank), {}};
  setting = watched(std::move(setting));
  Matrix dX(1, 8);
  setting.prior->mean(Matrix::Zero(1, 8), Matrix::Zero(1, 1), Vector(), dX);
  EXPECT_EQ(fault_of_prior(setting),
            "in a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, … under u = 0: it gives no change that can be used");
}

}  // namespace
}  // namespace rehearse::learners
