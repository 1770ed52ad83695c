#include "rehearse/identification/learn.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "learn_swing.hpp"
#include "pendubot_episode.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"

namespace rehearse::identification {
namespace {

using swing::error, swing::failing_above, swing::learn_swing;

struct Prediction {
  Matrix mean, variance;
};
Prediction predict(const dynamics::DynamicsModel& model, const Dataset& data) {
  Prediction p{Matrix(data.size(), data.states.cols()), Matrix(data.size(), data.states.cols())};
  model.predict(data.states, data.actions, p.mean, p.variance);
  return p;
}
// Seeds 1 and 2, 100 rows to learn from and 200 to predict; no noise: nothing is left to chance but the two draws.
TEST(Learn, ZeroMeanPredictsHeldOutSteps) {
  const Dataset data = swing::data(100, 1), held_out = swing::data(200, 2);
  const Learned learned = learn_swing(data, ZeroMean{});
  EXPECT_LT(error(*learned.model, held_out), 0.03 * swing::rms(held_out.changes));
  EXPECT_TRUE(std::isfinite(*learned.log_evidence));
  EXPECT_FALSE(learned.state.phi.has_value());
  EXPECT_EQ(learned.state.kernels.size(), 2u);
  const Prediction p = predict(*learned.model, held_out);
  EXPECT_GE(p.variance.minCoeff(), 0);
}

TEST(Learn, NoisyVarianceAddsTheLearnedNoise) {
  const Dataset data = swing::data(30, 1), held_out = swing::data(10, 2);
  ZeroMean noisy;
  noisy.gp.variance = dynamics::PredictedVariance::noisy;
  const Learned latent = learn_swing(data, ZeroMean{}), with_noise = learn_swing(data, noisy);
  const Matrix difference = predict(*with_noise.model, held_out).variance - predict(*latent.model, held_out).variance;
  for (Index e = 0; e < 2; ++e) {
    const double noise = latent.state.kernels[static_cast<std::size_t>(e)].noise_variance();
    for (Index i = 0; i < difference.rows(); ++i) EXPECT_NEAR(difference(i, e), noise, 1e-9 + 1e-6 * noise);
  }
}

TEST(Learn, PerfectPriorLeavesZeroResidualsAndAFiniteEvidence) {
  const Dataset data = swing::data(40, 1), held_out = swing::data(100, 2);
  const prior::Prior prior = swing::prior_at(swing::kTruth);
  for (const Kind& kind : {Kind(FixedPrior{}), Kind(GpMi{})}) {
    const Learned learned = learn_swing(data, kind, &prior);
    EXPECT_TRUE(std::isfinite(*learned.log_evidence));
    EXPECT_EQ(predict(*learned.model, held_out).mean, held_out.changes);
    EXPECT_LT(predict(*learned.model, held_out).variance.maxCoeff(), 1e-9);
    EXPECT_EQ(learned.state.phi, swing::kTruth);
  }
}

TEST(Learn, FixedPriorCorrectsAWrongPrior) {
  const Dataset data = swing::data(60, 1), held_out = swing::data(200, 2);
  const Vector wrong{{1.0, 0}};
  const prior::Prior prior = swing::prior_at(wrong);
  Matrix prior_mean(held_out.size(), 2);
  prior.mean(held_out.states, held_out.actions, wrong, prior_mean);
  const Learned learned = learn_swing(data, FixedPrior{}, &prior);
  EXPECT_EQ(learned.state.phi, wrong);
  EXPECT_LT(error(*learned.model, held_out), 0.1 * swing::rms(prior_mean - held_out.changes));
}

TEST(Learn, GpMiAndMiIdentifyContinuousParameters) {
  const Dataset data = swing::data(25, 1);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  for (const Kind& kind : {Kind(GpMi{}), Kind(Mi{})}) {
    const Learned learned = learn_swing(data, kind, &prior);
    EXPECT_NEAR((*learned.state.phi)(0), 0.8, 0.008);
    EXPECT_NEAR((*learned.state.phi)(1), 0.3, 0.01);
    EXPECT_GT(learned.evaluations, 1);
  }
}

TEST(Learn, IdentifiesDiscreteParametersAndMixtures) {
  const Dataset data = swing::data(25, 1);
  const Parameter lengths = Parameter::discrete("length", 0.5, {0.5, 0.65, 0.8, 0.95});
  const Parameter frictions = Parameter::discrete("friction", 0, {0, 0.3, 0.6});
  const prior::Prior all_discrete = swing::prior({lengths, frictions});
  const prior::Prior mixture = swing::prior({swing::length(), frictions});
  for (const Kind& kind : {Kind(GpMi{}), Kind(Mi{})}) {
    const Learned exact = learn_swing(data, kind, &all_discrete);
    EXPECT_EQ(exact.state.phi, swing::kTruth);
    EXPECT_EQ(exact.evaluations, 12) << "every combination once";
    const Learned mixed = learn_swing(data, kind, &mixture);
    EXPECT_NEAR((*mixed.state.phi)(0), 0.8, 0.008);
    EXPECT_EQ((*mixed.state.phi)(1), 0.3);
  }
}

TEST(Learn, ChoosesTheRightPriorAmongSeveral) {
  const auto spring = [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    dxdt(0) = -x(1) / phi(0) + u(0);
    dxdt(1) = x(0);
  };
  const prior::Prior right = swing::prior({swing::length(), swing::friction()});
  const prior::Prior wrong = swing::prior({swing::length(), swing::friction()}, spring);
  const prior::Prior priors = prior::choice({wrong, right, wrong});
  const Dataset data = swing::data(25, 1);
  for (const Kind& kind : {Kind(GpMi{}), Kind(Mi{})}) {
    const Learned learned = learn_swing(data, kind, &priors);
    EXPECT_EQ((*learned.state.phi)(0), 1);
    EXPECT_NEAR((*learned.state.phi)(priors.space.find("length")), 0.8, 0.008);
  }
}

// Seeds 1 to 3; the plant is free of noise, so that only the policies are drawn.
TEST(Learn, GpMiIdentifiesThePendubotFromOneEpisode) {
  const scenario::Scenario s = robots::pendubot::make({});
  const auto& guess = s.priors[2];
  ASSERT_EQ(guess.name, "misleading");
  const prior::Prior prior{guess.name, guess.simulator, guess.parameters};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Dataset data = one_episode(s, seed);
    ASSERT_EQ(data.size(), 50);
    const Learned learned =
        learn({data, s.task.feature_map(), s.task.kinematics(), &prior}, GpMi{}, {}, serial_evaluator());
    for (Index i = 0; i < 4; ++i) EXPECT_NEAR((*learned.state.phi)(i), 0.5, 0.01) << "seed " << seed << " φ " << i;
  }
}

TEST(Learn, AnyScoreIdentifiesTheSwing) {
  const Dataset data = swing::data(25, 1);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  for (const Score score : {Score::sum, Score::product, Score::harmonic}) {
    GpMi kind;
    kind.score = score;
    EXPECT_NEAR((*learn_swing(data, kind, &prior).state.phi)(0), 0.8, 0.016) << static_cast<int>(score);
  }
}

TEST(Learn, SameBytesWithOneAndTwoThreads) {
  const Dataset data = swing::data(25, 1), held_out = swing::data(20, 2);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const auto threads = make_thread_evaluator(2);
  for (const Kind& kind : {Kind(ZeroMean{}), Kind(FixedPrior{}), Kind(GpMi{})}) {
    const Learned one = learn_swing(data, kind, &prior), two = learn_swing(data, kind, &prior, {}, *threads);
    EXPECT_EQ(one.log_evidence, two.log_evidence);
    EXPECT_EQ(one.state.phi, two.state.phi);
    EXPECT_EQ(predict(*one.model, held_out).mean, predict(*two.model, held_out).mean);
    EXPECT_EQ(predict(*one.model, held_out).variance, predict(*two.model, held_out).variance);
  }
}

TEST(Learn, WarmStartIsNoWorse) {
  const Dataset data = swing::data(40, 1);
  const Vector wrong{{1.0, 0}};
  const prior::Prior prior = swing::prior_at(wrong);
  const Learned cold = learn_swing(data, FixedPrior{}, &prior);
  const Learned warm = learn_swing(data, FixedPrior{}, &prior, cold.state);
  EXPECT_GE(*warm.log_evidence, *cold.log_evidence - 1e-9);
}

TEST(Learn, MiIsThePriorAtItsWord) {
  const Dataset data = swing::data(25, 1), held_out = swing::data(20, 2);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const Learned learned = learn_swing(data, Mi{}, &prior);
  Matrix expected(held_out.size(), 2);
  prior.mean(held_out.states, held_out.actions, *learned.state.phi, expected);
  EXPECT_EQ(predict(*learned.model, held_out).mean, expected);
  EXPECT_EQ(predict(*learned.model, held_out).variance, Matrix::Zero(held_out.size(), 2));
  EXPECT_FALSE(learned.log_evidence.has_value());
}

TEST(Learn, SaysWhatIsMissing) {
  const Dataset data = swing::data(10, 1);
  const prior::Prior fails = failing_above(-10, {swing::length(), swing::friction()});
  for (const Kind& kind : {Kind(FixedPrior{}), Kind(GpMi{}), Kind(Mi{})})
    EXPECT_THROW(learn_swing(data, kind), InvalidInput);
  EXPECT_THROW(learn_swing({}, ZeroMean{}), InvalidInput);
  for (const Kind& kind : {Kind(FixedPrior{}), Kind(GpMi{})})
    EXPECT_THROW(learn_swing(data, kind, &fails), InvalidInput) << kind.index();
}

TEST(Learn, OneRowAndRepeatedRowsAreEnoughToGoOn) {
  Dataset one = swing::data(1, 1), same = swing::data(20, 1);
  same.states.rowwise() = Eigen::RowVector2d(0.1, 0.2);
  same.actions.setConstant(0.3);
  same.changes.rowwise() = Eigen::RowVector2d(0.5, 0.6);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const Dataset held_out = swing::data(20, 2);
  for (const Dataset& data : {one, same}) {
    for (const Kind& kind : {Kind(ZeroMean{}), Kind(FixedPrior{}), Kind(GpMi{}), Kind(Mi{})}) {
      const Prediction p = predict(*learn_swing(data, kind, &prior).model, held_out);
      EXPECT_TRUE(p.mean.allFinite() && p.variance.allFinite()) << data.size() << " " << kind.index();
    }
  }
}

/// Many states, of which only the second changes by more than noise, in proportion to the first.
Dataset mostly_noise(Index n, std::uint64_t seed) {
  constexpr Index states = 18;
  Rng rng({.seed = seed});
  const auto normal = [&] { return rng.normal(); };
  Dataset data{.states = Matrix::NullaryExpr(n, states, normal), .actions = Matrix::NullaryExpr(n, 1, normal)};
  data.changes = 0.1 * Matrix::NullaryExpr(n, states, normal);
  data.changes.col(1) += data.states.col(0);
  return data;
}

TEST(Learn, NoiseIsNoFunctionOfManyInputs) {
  const Dataset data = mostly_noise(120, 1), held_out = mostly_noise(50, 2);
  const FeatureMap features(std::vector<StateKind>(static_cast<std::size_t>(data.states.cols())));
  const Learned learned = learn({data, features, {}, nullptr}, ZeroMean{}, {}, serial_evaluator());
  const Prediction p = predict(*learned.model, held_out);
  EXPECT_LT(swing::rms(p.mean.col(1) - held_out.states.col(0)), 0.1);
  EXPECT_LT(swing::rms(p.mean.rightCols(16)), 1e-6);
  EXPECT_LT(p.variance.rightCols(16).maxCoeff(), 1e-6);
  for (Index e = 2; e < data.states.cols(); ++e)
    EXPECT_NEAR(std::exp(learned.state.kernels[static_cast<std::size_t>(e)].log_noise), 0.1, 0.03);
}

}  // namespace
}  // namespace rehearse::identification
