#include "rehearse/dynamics/simulator_model.hpp"

#include <gtest/gtest.h>

#include "swing.hpp"

namespace rehearse::dynamics {
namespace {

TEST(SimulatorModel, IsThePriorWithTheSameVarianceEverywhere) {
  const Dataset at = swing::data(30, 2);
  const SimulatorModel model(swing::prior_at(swing::kTruth), swing::kTruth, 0.25);
  Matrix mean(30, 2), variance(30, 2);
  model.predict(at.states, at.actions, mean, variance);
  EXPECT_EQ(mean, at.changes);
  EXPECT_EQ(variance, Matrix::Constant(30, 2, 0.25));
}

TEST(SimulatorModel, ContainsASimulatorThatThrows) {
  const Dataset at = swing::data(30, 2);
  const auto hostile = [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    if (u(0) > 0.5) throw 1;
    swing::ode(x, u, phi, dxdt);
  };
  const SimulatorModel model(swing::prior({swing::length(), swing::friction()}, hostile), swing::kTruth);
  Matrix mean(30, 2), variance(30, 2);
  model.predict(at.states, at.actions, mean, variance);
  for (Index i = 0; i < 30; ++i) {
    if (at.actions(i, 0) > 0.5) {
      EXPECT_TRUE(mean.row(i).array().isNaN().all());
    } else {
      EXPECT_EQ(mean.row(i), at.changes.row(i));
    }
  }
}

}  // namespace
}  // namespace rehearse::dynamics
