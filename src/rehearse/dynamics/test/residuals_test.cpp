#include "rehearse/dynamics/residuals.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/gp_model.hpp"
#include "swing.hpp"

namespace rehearse::dynamics {
namespace {

TEST(Residuals, WithoutAPriorAreTheChanges) {
  const Dataset data = swing::data(20, 1);
  const Residuals residuals(data, swing::features());
  const Residuals::Rows rows = residuals.at(nullptr, {});
  EXPECT_EQ(rows.targets, data.changes);
  EXPECT_EQ(rows.left_out, 0);
  EXPECT_EQ(rows.inputs->size(), 20);
  EXPECT_EQ(rows.inputs->dimensions(), 4) << "speed, cosine, sine, action";
  EXPECT_EQ(residuals.size(), 20);
}

TEST(Residuals, ScaleIsTheSpreadOfTheRawChanges) {
  const Dataset data = swing::data(20, 1);
  const Residuals residuals(data, swing::features());
  for (Index e = 0; e < 2; ++e) {
    const Eigen::ArrayXd y = data.changes.col(e);
    EXPECT_NEAR(residuals.scale()(e), std::sqrt((y - y.mean()).square().sum() / 19), 1e-12);
  }
}

TEST(Residuals, SubtractThePriorMean) {
  const Dataset data = swing::data(20, 1);
  const Vector phi{{0.6, 0}};
  const prior::Prior prior = swing::prior_at(phi);
  Matrix mean(20, 2);
  prior.mean(data.states, data.actions, phi, mean);
  EXPECT_EQ(Residuals(data, swing::features()).at(&prior, phi).targets, data.changes - mean);
}

TEST(Residuals, OfPositionsAreWhatIntegralsOfTheRatesLeave) {
  const Dataset data = swing::data(20, 1);
  const Matrix plain = Residuals(data, swing::features()).at(nullptr, {}).targets;
  const Matrix integrated = Residuals(data, swing::features(), swing::kinematics()).at(nullptr, {}).targets;
  const Vector trapezoid = 0.1 * (data.states.col(0) + 0.5 * data.changes.col(0));
  EXPECT_EQ(integrated.col(0), plain.col(0));
  EXPECT_LT((integrated.col(1) - (plain.col(1) - trapezoid)).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT(integrated.col(1).cwiseAbs().maxCoeff(), 0.03 * plain.col(1).cwiseAbs().maxCoeff());
}

TEST(Residuals, InputsMayBeHalfwayAlongThePriorsStep) {
  const Dataset data = swing::data(20, 1);
  const Vector phi{{0.6, 0}};
  const prior::Prior prior = swing::prior_at(phi);
  Matrix mean(20, 2);
  prior.mean(data.states, data.actions, phi, mean);
  const Residuals at_start(data, swing::features()), halfway(data, swing::features(), {}, true);
  const Residuals::Rows rows = halfway.at(&prior, phi);
  EXPECT_EQ(rows.targets, at_start.at(&prior, phi).targets);
  const gp::Inputs expected(gp_inputs(swing::features(), data.states + 0.5 * mean, data.actions));
  EXPECT_EQ(rows.inputs->unit(), expected.unit());
  EXPECT_EQ(halfway.at(nullptr, {}).inputs->unit(), at_start.at(nullptr, {}).inputs->unit()) << "without a prior";
}

TEST(Residuals, WithoutAPriorInputsMayHavePositionsHalfwayAlongTheStepOfTheirRates) {
  const Dataset data = swing::data(20, 1);
  const Kinematics kinematics = swing::kinematics();
  const auto rows = Residuals(data, swing::features(), kinematics, true).at(nullptr, {});
  Matrix halfway = data.states;
  halfway.col(1) += 0.5 * kinematics.dt_s * data.states.col(0);
  EXPECT_EQ(rows.inputs->unit(), gp::Inputs(gp_inputs(swing::features(), halfway, data.actions)).unit());
  EXPECT_EQ(rows.targets, Residuals(data, swing::features(), kinematics).at(nullptr, {}).targets);
  const Dataset nothing{Matrix(0, 2), Matrix(0, 1), Matrix(0, 2), Vector()};
  EXPECT_FALSE(Residuals(nothing, swing::features(), kinematics, true).at(nullptr, {}).inputs);
}

TEST(Residuals, RowsThatFailAreLeftOut) {
  const Dataset data = swing::data(20, 1);
  const auto fails = [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    swing::ode(x, u, phi, dxdt);
    if (u(0) > 0) dxdt(0) = kNaN;
  };
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()}, fails);
  const Residuals::Rows rows = Residuals(data, swing::features()).at(&prior, swing::kTruth);
  const Index positive = (data.actions.array() > 0).count();
  EXPECT_EQ(rows.left_out, positive);
  EXPECT_EQ(rows.inputs->size(), 20 - positive);
  EXPECT_EQ(rows.targets, Matrix::Zero(20 - positive, 2));
}

// A robot may diverge in an episode. Squares of its numbers would be infinite, and no kernel could be fitted.
TEST(Residuals, RowsThatCannotBeSquaredAreLeftOut) {
  Dataset data = swing::data(20, 1);
  const Vector scale = Residuals(data, swing::features()).scale();
  data.changes(7, 0) = 1e160;
  for (const bool midpoint : {false, true}) {
    const Residuals residuals(data, swing::features(), swing::kinematics(), midpoint);
    const Residuals::Rows rows = residuals.at(nullptr, {});
    EXPECT_EQ(rows.left_out, 1);
    EXPECT_EQ(rows.inputs->size(), 19);
    EXPECT_TRUE(rows.targets.allFinite() && rows.targets.cwiseAbs().maxCoeff() < 100);
    EXPECT_LT((residuals.scale() - scale).cwiseAbs().maxCoeff(), 0.5 * scale.maxCoeff());
  }
}

TEST(Residuals, NoRowLeftHasNoInputs) {
  const Dataset data = swing::data(20, 1);
  const auto fails = [](const Vector&, const Vector&, const Vector&, Vector&) { throw 1; };
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()}, fails);
  const Residuals::Rows rows = Residuals(data, swing::features()).at(&prior, swing::kTruth);
  EXPECT_EQ(rows.inputs, nullptr);
  EXPECT_EQ(rows.left_out, 20);
}

}  // namespace
}  // namespace rehearse::dynamics
