#include "rehearse/identification/learn.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"
#include "rehearse/rollout/execute.hpp"
#include "swing.hpp"

namespace rehearse::identification {
namespace {

Learned learn_swing(const Dataset& data, const Kind& kind, const prior::Prior* prior = nullptr,
                    const WarmStart& start = {}, const Evaluator& evaluator = serial_evaluator()) {
  return learn(data, swing::features(), {}, prior, kind, start, evaluator);
}

struct Prediction {
  Matrix mean, variance;
};
Prediction predict(const dynamics::DynamicsModel& model, const Dataset& data) {
  Prediction p{Matrix(data.size(), data.states.cols()), Matrix(data.size(), data.states.cols())};
  model.predict(data.states, data.actions, p.mean, p.variance);
  return p;
}
double error(const dynamics::DynamicsModel& model, const Dataset& data) {
  return swing::rms(predict(model, data).mean - data.changes);
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

/// The measured steps of one episode of a random policy on the pendubot.
Dataset one_episode(const scenario::Scenario& s, std::uint64_t seed) {
  Rng rng({.seed = seed, .purpose = Purpose::random_policy});
  Vector theta(s.policy->parameters());
  for (double& value : theta) value = rng.uniform(-5, 5);
  Dataset data;
  data.append(rollout::execute(*s.make_plant(), *s.policy, theta, s.task, rng));
  return data;
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
        learn(data, s.task.feature_map(), s.task.kinematics(), &prior, GpMi{}, {}, serial_evaluator());
    for (Index i = 0; i < 4; ++i) EXPECT_NEAR((*learned.state.phi)(i), 0.5, 0.01) << "seed " << seed << " φ " << i;
  }
}

// The alternating search has many chances to stop lower than the plain one; seed 1, with and without noise.
TEST(Learn, GpMiFindsNoLowerScoreThanTheNestedSearch) {
  for (const double noise : {0.0, 0.01}) {
    robots::pendubot::Options options;
    options.ode.measurement_noise = noise;
    const scenario::Scenario s = robots::pendubot::make(options);
    const Dataset data = one_episode(s, 1);
    for (const auto& guess : s.priors) {
      if (guess.name != "misleading" && guess.name != "partial") continue;
      const prior::Prior prior{guess.name, guess.simulator, guess.parameters};
      GpMi by_turns, nested;
      nested.search = PhiSearch::nested;
      by_turns.gp.smooth = nested.gp.smooth = false;
      const auto score = [&](const GpMi& kind) {
        return *learn(data, s.task.feature_map(), s.task.kinematics(), &prior, kind, {}, serial_evaluator()).score;
      };
      EXPECT_GT(score(by_turns), score(nested) - 0.01) << guess.name << " noise " << noise;
    }
  }
}

/// The swing with a wind that the prior does not know of, so that kernels and φ have something to settle.
Dataset windy(Index n) {
  Dataset data = swing::data(n, 1);
  data.changes.col(0).array() += 0.2 * (data.states.col(1).array() * 2).sin() * data.states.col(0).array().tanh();
  return data;
}

// 200 rows are searched on a part of 67 of them first, 500 on two parts, and these go on with one fit alone.
TEST(Learn, GpMiOnManyRowsIsNoWorseThanNestedAndTheSameForAnyNumberOfThreads) {
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const auto threads = make_thread_evaluator(2);
  for (const Index rows : {200, 500}) {
    const Dataset data = windy(rows);
    GpMi nested;
    nested.search = PhiSearch::nested;
    const Learned learned = learn_swing(data, GpMi{}, &prior);
    if (rows == 200) {  // else it takes long
      EXPECT_GT(*learned.score, *learn_swing(data, nested, &prior).score - 0.01);
    }
    const Learned same = learn_swing(data, GpMi{}, &prior, {}, *threads);
    EXPECT_EQ(same.state.phi, learned.state.phi);
    EXPECT_EQ(same.score, learned.score);
  }
}

// Hurried, what the parts lead to is worse than what it is given.
TEST(Learn, GpMiIsNeverWorseThanWhereItStarts) {
  const Dataset data = windy(200);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const Learned first = learn_swing(data, GpMi{}, &prior);
  GpMi hurried;
  hurried.gp.fit.bfgs.max_evaluations = 2;
  EXPECT_GE(*learn_swing(data, hurried, &prior, first.state).score, *first.score - 1e-6);
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

/// The swing whose simulator fails where the angle is above `limit`.
prior::Prior failing_above(double limit, std::vector<Parameter> parameters) {
  return swing::prior(std::move(parameters),
                      [limit](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
                        swing::ode(x, u, phi, dxdt);
                        if (x(1) > limit) dxdt(0) = std::numeric_limits<double>::quiet_NaN();
                      });
}

TEST(Learn, LeavesOutAndCountsRowsThatFail) {
  const Dataset data = swing::data(60, 1);
  const prior::Prior prior = failing_above(2, {swing::length(), swing::friction()});
  Matrix mean(60, 2);
  const Index failing = prior.mean(data.states, data.actions, swing::kTruth, mean);
  ASSERT_GT(failing, 3);
  for (const Kind& kind : {Kind(FixedPrior{}), Kind(GpMi{}), Kind(Mi{})}) {
    const Learned learned = learn_swing(data, kind, &prior);
    EXPECT_NEAR(learned.left_out_rows, failing, 3);  // near the limit it depends on φ
    if (std::holds_alternative<FixedPrior>(kind)) continue;
    EXPECT_NEAR((*learned.state.phi)(0), 0.8, 0.016);
  }
}

// A clock, say: its changes do not vary, and a row that fails must not earn what its density would be.
TEST(Learn, AStateThatChangesEvenlyDoesNotRewardFailures) {
  Dataset data = swing::data(60, 1);
  data.changes.col(1).setConstant(0.1);
  const auto clock = [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    swing::ode(x, u, phi, dxdt);
    dxdt(1) = 1;
    if (phi(0) < 1 && x(0) > 0) dxdt(0) = std::numeric_limits<double>::quiet_NaN();
  };
  const prior::Prior prior = swing::prior({Parameter::discrete("length", 0.5, {0.5, 1.2}), swing::friction()}, clock);
  const Learned learned = learn_swing(data, GpMi{}, &prior);
  EXPECT_EQ((*learned.state.phi)(0), 1.2);
  EXPECT_EQ(learned.left_out_rows, 0);
}

// The shorter swing is the worse one, but can be simulated only where gravity hardly pulls: there it predicts well.
TEST(Learn, AParameterDoesNotWinByFailingWhereItIsWrong) {
  const auto fragile = [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    swing::ode(x, u, phi, dxdt);
    if (phi(0) < 1 && std::abs(std::sin(x(1))) > 0.4) dxdt(0) = std::numeric_limits<double>::quiet_NaN();
  };
  const prior::Prior prior = swing::prior({Parameter::discrete("length", 0.5, {0.5, 1.2}), swing::friction()}, fragile);
  for (const Kind& kind : {Kind(GpMi{}), Kind(Mi{})}) {
    const Learned learned = learn_swing(swing::data(60, 1), kind, &prior);
    EXPECT_EQ((*learned.state.phi)(0), 1.2) << kind.index();
    EXPECT_EQ(learned.left_out_rows, 0);
  }
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
  const Learned learned = learn(data, features, {}, nullptr, ZeroMean{}, {}, serial_evaluator());
  const Prediction p = predict(*learned.model, held_out);
  EXPECT_LT(swing::rms(p.mean.col(1) - held_out.states.col(0)), 0.1);
  EXPECT_LT(swing::rms(p.mean.rightCols(16)), 1e-6);
  EXPECT_LT(p.variance.rightCols(16).maxCoeff(), 1e-6);
  for (Index e = 2; e < data.states.cols(); ++e)
    EXPECT_NEAR(std::exp(learned.state.kernels[static_cast<std::size_t>(e)].log_noise), 0.1, 0.03);
}

}  // namespace
}  // namespace rehearse::identification
