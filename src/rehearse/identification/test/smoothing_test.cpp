#include "rehearse/identification/smoothing/smoothing.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/dynamics/test/swing.hpp"
#include "rehearse/identification/learn.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"
#include "rehearse/rollout/execute.hpp"

namespace rehearse::identification {
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

Learned learn_with_smoothing(const Dataset& data, bool smooth, const prior::Prior& prior, const Evaluator& evaluator) {
  GpMi kind;
  kind.gp.smooth = smooth;
  return learn({data, swing::features(), swing::kinematics(), &prior}, kind, {}, evaluator);
}

double rms_error(const dynamics::DynamicsModel& model, const Dataset& truth) {
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
    const Learned raw = learn_with_smoothing(m.data, false, prior, serial_evaluator());
    const Learned smoothed = learn_with_smoothing(m.data, true, prior, serial_evaluator());
    EXPECT_GT(*smoothed.log_evidence, *raw.log_evidence + 20);
    const Vector deviation = smoothed.posterior->covariance.diagonal().cwiseSqrt();
    for (Index i = 0; i < 2; ++i) {
      EXPECT_LT(std::abs((*smoothed.state.phi)(i)-swing::kTruth(i)), 4 * deviation(i)) << seed;
      EXPECT_LT(deviation(i), 0.1);
      EXPECT_NEAR(smoothed.model->measurement_std()(i) / kNoise(i), 1, 0.3) << seed;
    }
    smoothed_error += rms_error(*smoothed.model, other.truth);
    raw_error += rms_error(*raw.model, other.truth);
  }
  EXPECT_LT(smoothed_error, 0.7 * raw_error);
}

TEST(Smoothing, MovesStatesTowardsTheTrueOnes) {
  const Measured m = measured(kNoise, 1);
  const prior::Prior prior = swing::prior({swing::length(0.9), swing::friction()});
  const dynamics::Residuals residuals(m.data, swing::features(), swing::kinematics(), true);
  const gp::FitOptions options = GpMi{}.gp.fit;
  const FitProblem problem{residuals, &prior, Score::product, options, serial_evaluator()};
  Fit fit = unfitted(prior.space.values(), 2, {});
  problem.refit(fit);
  for (const bool moves_phi : {false, true}) {
    const auto smoothed = smooth(problem, fit, moves_phi);
    ASSERT_TRUE(smoothed.has_value());
    EXPECT_LT(swing::rms(smoothed->data.states - m.truth.states), 0.6 * swing::rms(m.data.states - m.truth.states));
    EXPECT_EQ(smoothed->fit.phi == prior.space.values(), !moves_phi);
  }
}

TEST(Smoothing, LeavesExactStatesAlone) {
  const Measured m = measured(Vector::Zero(2), 1);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const Learned raw = learn_with_smoothing(m.data, false, prior, serial_evaluator());
  const Learned smoothed = learn_with_smoothing(m.data, true, prior, serial_evaluator());
  EXPECT_EQ(*smoothed.state.phi, *raw.state.phi);
  EXPECT_EQ(*smoothed.log_evidence, *raw.log_evidence);
}

// Random policy of seed 3: noise a millionth of the changes would make these steps 59 nats likelier than the first fit
// of GPs, and no likelier than a better one.
TEST(Smoothing, LeavesAMisfitAlone) {
  const scenario::Scenario scenario = robots::pendubot::make(robots::pendubot::Options{});
  const scenario::NamedPrior& partial = scenario.priors.back();
  ASSERT_EQ(partial.name, "partial");
  const prior::Prior prior{partial.name, partial.simulator, partial.parameters};
  Rng rng({.seed = 3, .purpose = Purpose::random_policy});
  const policy::Policy& policy = *scenario.policy;
  const Vector theta = Vector::NullaryExpr(policy.parameters(), [&] { return rng.uniform(-5, 5); });
  Dataset data;
  data.append(rollout::execute(*scenario.make_plant(), policy, theta, scenario.task, rng));
  const Learned learned =
      learn({data, scenario.task.model_features(), scenario.task.kinematics(), &prior}, GpMi{}, {}, serial_evaluator());
  const auto& model = dynamic_cast<const dynamics::GpModel&>(*learned.model);
  for (std::size_t e = 0; e < 4; ++e)  // smoothed rows have noise of their own
    EXPECT_EQ(model.posterior().noise_variances()(static_cast<Index>(e)), learned.state.kernels[e].noise_variance());
}

TEST(Smoothing, NeedsStepsThatShareMeasurements) {
  Dataset data = swing::data(90, 1);
  Rng rng({.seed = 1, .purpose = Purpose::test});
  for (double& change : data.changes.reshaped()) change += 0.05 * rng.normal();
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  EXPECT_EQ(*learn_with_smoothing(data, true, prior, serial_evaluator()).state.phi,
            *learn_with_smoothing(data, false, prior, serial_evaluator()).state.phi);
}

TEST(Smoothing, LeavesPhiWhereAnotherScoreOrSearchFoundIt) {
  const Measured m = measured(kNoise, 1);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  GpMi sum, nested;
  sum.score = Score::sum;
  nested.search = PhiSearch::nested;
  for (GpMi kind : {sum, nested}) {
    const Learned smoothed =
        learn({m.data, swing::features(), swing::kinematics(), &prior}, kind, {}, serial_evaluator());
    kind.gp.smooth = false;
    const Learned raw = learn({m.data, swing::features(), swing::kinematics(), &prior}, kind, {}, serial_evaluator());
    EXPECT_EQ(*smoothed.state.phi, *raw.state.phi);
    EXPECT_EQ(*smoothed.score, *raw.score);
    EXPECT_GT(*smoothed.log_evidence, *raw.log_evidence + 20) << "GPs learn from smoothed states all the same";
  }
}

TEST(Smoothing, HasTheSameBitsOnAnyThreads) {
  const Measured m = measured(kNoise, 1);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const Learned one = learn_with_smoothing(m.data, true, prior, serial_evaluator());
  const Learned more = learn_with_smoothing(m.data, true, prior, *make_thread_evaluator(3));
  EXPECT_EQ(*one.state.phi, *more.state.phi);
  EXPECT_EQ(one.model->measurement_std(), more.model->measurement_std());
  EXPECT_EQ(*one.log_evidence, *more.log_evidence);
}

TEST(Smoothing, RefusesARowThatFails) {
  const Measured m = measured(kNoise, 1);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const dynamics::Residuals residuals(m.data, swing::features(), swing::kinematics());
  const gp::FitOptions options = GpMi{}.gp.fit;
  const FitProblem problem{residuals, &prior, Score::product, options, serial_evaluator()};
  Fit fit = unfitted(prior.space.values(), 2, {});
  problem.refit(fit);
  fit.left_out = 1;
  EXPECT_FALSE(smooth(problem, fit, true).has_value());
}

}  // namespace
}  // namespace rehearse::identification
