#include "rehearse/dynamics/gp_model.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/residuals.hpp"
#include "swing.hpp"

namespace rehearse::dynamics {
namespace {

gp::Posterior posterior(const Dataset& data, const Matrix& targets) {
  Matrix F(data.size(), 4);
  gp_inputs(swing::features(), data.states, data.actions, F);
  const gp::Hyperparameters kernel{.log_lengths = Vector::Zero(4), .log_signal = 0, .log_noise = std::log(0.1)};
  return gp::Posterior(gp::Inputs(F), targets, {kernel, kernel});
}

struct Prediction {
  Matrix mean, variance;
};
Prediction predict(const DynamicsModel& model, const Matrix& X, const Matrix& U) {
  Prediction p{Matrix(X.rows(), 2), Matrix(X.rows(), 2)};
  model.predict(X, U, p.mean, p.variance);
  Matrix mean(X.rows(), 2);
  model.predict_mean(X, U, mean);
  for (Index i = 0; i < X.rows(); ++i)
    EXPECT_TRUE(mean.row(i) == p.mean.row(i) || !p.mean.row(i).allFinite()) << "the mean alone is another, row " << i;
  return p;
}

TEST(GpInputs, AreFeaturesThenActions) {
  const Dataset data = swing::data(5, 1);
  Matrix F(5, 4);
  gp_inputs(swing::features(), data.states, data.actions, F);
  for (Index i = 0; i < 5; ++i) {
    EXPECT_EQ(F(i, 0), data.states(i, 0));
    EXPECT_NEAR(F(i, 1), std::cos(data.states(i, 1)), 1e-14);
    EXPECT_NEAR(F(i, 2), std::sin(data.states(i, 1)), 1e-14);
    EXPECT_EQ(F(i, 3), data.actions(i, 0));
  }
}

TEST(GpModel, IsPriorMeanPlusPosterior) {
  const Dataset data = swing::data(20, 1), at = swing::data(30, 2);
  const prior::Prior prior = swing::prior_at(swing::kTruth);
  const GpModel without(swing::features(), {}, {}, posterior(data, data.changes), PredictedVariance::latent);
  const GpModel with(swing::features(), {}, Mean{prior, swing::kTruth}, posterior(data, data.changes),
                     PredictedVariance::latent);
  const Prediction a = predict(without, at.states, at.actions), b = predict(with, at.states, at.actions);
  EXPECT_LT((b.mean - a.mean - at.changes).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(a.variance, b.variance);
}

TEST(GpModel, LooksHalfwayAlongThePriorsStepIfAskedTo) {
  const Dataset data = swing::data(20, 1), at = swing::data(30, 2);
  const Vector phi{{0.6, 0}};
  const prior::Prior prior = swing::prior_at(phi);
  const GpModel without(swing::features(), {}, {}, posterior(data, data.changes), PredictedVariance::latent);
  const GpModel halfway(swing::features(), {}, Mean{prior, phi}, posterior(data, data.changes),
                        PredictedVariance::latent, true);
  Matrix mean(30, 2);
  prior.mean(at.states, at.actions, phi, mean);
  const Prediction a = predict(without, at.states + 0.5 * mean, at.actions),
                   b = predict(halfway, at.states, at.actions);
  EXPECT_EQ(b.mean, a.mean + mean);
  EXPECT_EQ(a.variance, b.variance);
}

TEST(GpModel, LooksAtPositionsHalfwayAlongTheStepOfTheirRatesWithoutAPrior) {
  const Dataset data = swing::data(20, 1), at = swing::data(30, 2);
  const Kinematics kinematics = swing::kinematics();
  const auto model = [&](bool midpoint) {
    return GpModel(swing::features(), kinematics, {}, posterior(data, data.changes), PredictedVariance::latent,
                   midpoint);
  };
  Matrix halfway = at.states;
  halfway.col(1) += 0.5 * kinematics.dt_s * at.states.col(0);
  const Prediction a = predict(model(false), halfway, at.actions), b = predict(model(true), at.states, at.actions);
  EXPECT_EQ(a.mean, b.mean) << "the rates, which integrals need, are the same";
  EXPECT_EQ(a.variance, b.variance);
}

// Predictions of GPs are added to the integrals that they did not learn, with a prior and without.
TEST(GpModel, GivesBackTheIntegralsOfTheRates) {
  const Dataset data = swing::data(20, 1);
  const prior::Prior prior = swing::prior_at(Vector{{0.6, 0}});
  for (const prior::Prior* around : {static_cast<const prior::Prior*>(nullptr), &prior}) {
    const Vector phi = around ? around->space.values() : Vector();
    const Matrix targets = Residuals(data, swing::features(), swing::kinematics()).at(around, phi).targets;
    const gp::Hyperparameters exact{.log_lengths = Vector::Zero(4), .log_signal = 0, .log_noise = std::log(1e-4)};
    const gp::Posterior posterior(gp::Inputs(gp_inputs(swing::features(), data.states, data.actions)), targets,
                                  {exact, exact});
    std::optional<Mean> mean;
    if (around) mean = Mean{prior, phi};
    const Prediction p =
        predict(GpModel(swing::features(), swing::kinematics(), mean, posterior, PredictedVariance::latent),
                data.states, data.actions);
    EXPECT_LT((p.mean - data.changes).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST(GpModel, AnUncertainRateMakesThePositionUncertain) {
  const Dataset data = swing::data(20, 1), at = swing::data(30, 2);
  const auto variance = [&](const Kinematics& kinematics) {
    const GpModel model(swing::features(), kinematics, {}, posterior(data, data.changes), PredictedVariance::latent);
    return predict(model, at.states, at.actions).variance;
  };
  const Matrix without = variance({}), with = variance(swing::kinematics());
  EXPECT_EQ(with.col(0), without.col(0));
  EXPECT_LT((with.col(1) - without.col(1) - 0.0025 * without.col(0)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(GpModel, NoisyVarianceIsLatentPlusNoise) {
  const Dataset data = swing::data(20, 1), at = swing::data(30, 2);
  const GpModel latent(swing::features(), {}, {}, posterior(data, data.changes), PredictedVariance::latent);
  const GpModel noisy(swing::features(), {}, {}, posterior(data, data.changes), PredictedVariance::noisy);
  const Matrix difference =
      predict(noisy, at.states, at.actions).variance - predict(latent, at.states, at.actions).variance;
  EXPECT_LT((difference.array() - 0.01).abs().maxCoeff(), 1e-12);
}

/// Expects the derivatives of DynamicsModel, which are differences.
void expect_derivatives(const GpModel& model, const Matrix& X, const Matrix& U) {
  Linearised own, differences;
  model.linearise(X, U, own);
  model.DynamicsModel::linearise(X, U, differences);
  EXPECT_EQ(own.mean, differences.mean);
  EXPECT_EQ(own.variance, differences.variance);
  EXPECT_LT((own.mean_by - differences.mean_by).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((own.variance_by - differences.variance_by).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_GT(own.mean_by.cwiseAbs().maxCoeff(), 0.1);
}

TEST(GpModel, IsLinearised) {
  const Dataset data = swing::data(20, 1), at = swing::data(70, 2);
  const prior::Prior prior = swing::prior_at(Vector{{0.6, 0}});
  for (const std::optional<Mean>& around : {std::optional<Mean>(), {Mean{prior, prior.space.values()}}})
    for (const Kinematics& kinematics : {Kinematics(), swing::kinematics()})
      for (const PredictedVariance variance : {PredictedVariance::latent, PredictedVariance::noisy})
        for (const bool midpoint : {false, true})
          expect_derivatives(
              GpModel(swing::features(), kinematics, around, posterior(data, data.changes), variance, midpoint),
              at.states, at.actions);
}

TEST(GpModel, WithTargetsOfStatesIsLinearised) {
  const Dataset data = swing::data(20, 1), at = swing::data(70, 2);
  const FeatureMap features({StateKind::plain, StateKind::angle}, {}, {0});
  expect_derivatives(GpModel(features, {}, {}, posterior(data, data.changes), PredictedVariance::latent), at.states,
                     at.actions);
}

TEST(GpModel, FailedRowsAreNanAndDisturbNoOther) {
  const Dataset data = swing::data(20, 1);
  Dataset at = swing::data(200, 2);
  const prior::Prior prior = swing::prior_at(swing::kTruth);
  const GpModel model(swing::features(), {}, Mean{prior, swing::kTruth}, posterior(data, data.changes),
                      PredictedVariance::latent);
  const Prediction clean = predict(model, at.states, at.actions);
  at.states(7, 0) = kNaN;
  at.states(150, 0) = 1e300;
  at.states(151, 1) = kInf;
  const Prediction spoilt = predict(model, at.states, at.actions);
  for (Index i = 0; i < 200; ++i) {
    if (i == 7 || i == 150 || i == 151) {
      EXPECT_FALSE(spoilt.mean.row(i).allFinite()) << i;
    } else {
      EXPECT_EQ(clean.mean.row(i), spoilt.mean.row(i)) << i;
      EXPECT_EQ(clean.variance.row(i), spoilt.variance.row(i)) << i;
    }
  }
}

TEST(GpModel, RowsDoNotDependOnTheBatch) {
  const Dataset data = swing::data(20, 1), at = swing::data(40, 2);
  const prior::Prior prior = swing::prior_at(swing::kTruth);
  const GpModel model(swing::features(), {}, Mean{prior, swing::kTruth}, posterior(data, data.changes),
                      PredictedVariance::latent);
  const Prediction all = predict(model, at.states, at.actions);
  for (Index i = 0; i < 40; ++i) {
    const Prediction one = predict(model, at.states.row(i), at.actions.row(i));
    EXPECT_EQ(one.mean, all.mean.row(i)) << i;
    EXPECT_EQ(one.variance, all.variance.row(i)) << i;
  }
}

}  // namespace
}  // namespace rehearse::dynamics
