#include "rehearse/dynamics/smoothing.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/learn.hpp"
#include "swing.hpp"

namespace rehearse::dynamics {
namespace {

const Vector kNoise{{0.05, 0.03}};

struct Measured {
  Dataset truth, data;
};

/// Three episodes of 30 steps.
Measured measured(const Vector& noise, std::uint64_t seed) {
  Rng rng({.seed = seed, .purpose = Purpose::test});
  const prior::Prior plant = swing::prior_at(swing::kTruth);
  Measured result;
  for (int k = 0; k < 3; ++k) {
    Episode episode{.states = Matrix(31, 2), .true_states = {}, .actions = Matrix(30, 1), .rewards = Vector::Zero(30)};
    episode.states.row(0) << rng.uniform(-2, 2), rng.uniform(-1, 1);
    for (Index t = 0; t < 30; ++t) {
      episode.actions(t, 0) = rng.uniform(-1, 1);
      Matrix change(1, 2);
      plant.mean(episode.states.row(t), episode.actions.row(t), swing::kTruth, change);
      episode.states.row(t + 1) = episode.states.row(t) + change;
    }
    result.truth.append(episode);
    for (Index t = 0; t <= 30; ++t)
      for (Index d = 0; d < 2; ++d) episode.states(t, d) += noise(d) * rng.normal();
    result.data.append(episode);
  }
  return result;
}

Learned learn_swing(const Dataset& data, bool smooth, const prior::Prior& prior, const Evaluator& evaluator) {
  GpMi kind;
  kind.gp.smooth = smooth;
  return learn(data, swing::features(), swing::kinematics(), &prior, kind, {}, evaluator);
}

double error(const DynamicsModel& model, const Dataset& truth) {
  Matrix mean(truth.size(), 2);
  model.predict_mean(truth.states, truth.actions, mean);
  return swing::rms(mean - truth.changes);
}

// Seeds 1 to 3.
TEST(Smoothing, FindsParametersNoiseAndDynamicsThatNoisyStepsHide) {
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  double smoothed_error = 0, raw_error = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Measured m = measured(kNoise, seed), other = measured(kNoise, 10 + seed);
    const Learned raw = learn_swing(m.data, false, prior, serial_evaluator());
    const Learned smoothed = learn_swing(m.data, true, prior, serial_evaluator());
    EXPECT_GT(*smoothed.log_evidence, *raw.log_evidence + 20);
    const Vector deviation = smoothed.posterior->covariance.diagonal().cwiseSqrt();
    for (Index i = 0; i < 2; ++i) {
      EXPECT_LT(std::abs((*smoothed.state.phi)(i)-swing::kTruth(i)), 4 * deviation(i)) << seed;
      EXPECT_LT(deviation(i), 0.1);
      EXPECT_NEAR(smoothed.model->measurement_std()(i) / kNoise(i), 1, 0.3) << seed;
    }
    smoothed_error += error(*smoothed.model, other.truth);
    raw_error += error(*raw.model, other.truth);
  }
  EXPECT_LT(smoothed_error, 0.7 * raw_error);
}

TEST(Smoothing, MovesStatesTowardsTheTrueOnes) {
  const Measured m = measured(kNoise, 1);
  const prior::Prior prior = swing::prior({swing::length(0.9), swing::friction()});
  const Residuals residuals(m.data, swing::features(), swing::kinematics(), true);
  gp::FitOptions fit = GpMi{}.gp.fit;
  const Estimation estimation{residuals, &prior, Score::product, fit, serial_evaluator()};
  Estimate estimate = unfitted(prior.space.values(), 2, {});
  estimation.refit(estimate);
  for (const bool moves_phi : {false, true}) {
    const auto smoothed = smooth(estimation, estimate, moves_phi);
    ASSERT_TRUE(smoothed.has_value());
    EXPECT_LT(swing::rms(smoothed->data.states - m.truth.states), 0.6 * swing::rms(m.data.states - m.truth.states));
    EXPECT_EQ(smoothed->estimate.phi == prior.space.values(), !moves_phi);
    EXPECT_EQ(smoothed->phi_covariance.size(), moves_phi ? 4 : 0);
  }
}

TEST(Smoothing, LeavesExactStatesAlone) {
  const Measured m = measured(Vector::Zero(2), 1);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const Learned raw = learn_swing(m.data, false, prior, serial_evaluator());
  const Learned smoothed = learn_swing(m.data, true, prior, serial_evaluator());
  EXPECT_EQ(*smoothed.state.phi, *raw.state.phi);
  EXPECT_EQ(*smoothed.log_evidence, *raw.log_evidence);
}

TEST(Smoothing, HasTheSameBitsOnAnyThreads) {
  const Measured m = measured(kNoise, 1);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const Learned one = learn_swing(m.data, true, prior, serial_evaluator());
  const Learned more = learn_swing(m.data, true, prior, *make_thread_evaluator(3));
  EXPECT_EQ(*one.state.phi, *more.state.phi);
  EXPECT_EQ(one.model->measurement_std(), more.model->measurement_std());
  EXPECT_EQ(*one.log_evidence, *more.log_evidence);
}

TEST(Smoothing, RefusesARowThatFails) {
  const Measured m = measured(kNoise, 1);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const Residuals residuals(m.data, swing::features(), swing::kinematics());
  gp::FitOptions fit = GpMi{}.gp.fit;
  const Estimation estimation{residuals, &prior, Score::product, fit, serial_evaluator()};
  Estimate estimate = unfitted(prior.space.values(), 2, {});
  estimation.refit(estimate);
  estimate.left_out = 1;
  EXPECT_FALSE(smooth(estimation, estimate, true).has_value());
}

}  // namespace
}  // namespace rehearse::dynamics
