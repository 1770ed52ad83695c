#include "rehearse/learners/pilco/model.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "learner.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/moments/requirements.hpp"

namespace rehearse::learners::pilco {
namespace {

using slider::asked_after, slider::builder, slider::run_trial, slider::setting, slider::task;

TEST(Model, HasInducingInputsBeyondTheLimitOnly) {
  const auto learner = builder()->build(setting());
  Dataset data;
  for (const std::uint64_t trial : {1, 2}) data.append(run_trial(learner->ask(), trial));
  const auto points = [&](Index inducing) {
    ModelOptions options;
    options.inducing = inducing;
    const Model model = pilco::learn({task(), data, options, serial_evaluator()}, {});
    EXPECT_EQ(model.notes, std::vector<std::string>{});
    return model.moments.gps->terms().front().size();
  };
  EXPECT_EQ(points(24), 24);
  EXPECT_EQ(points(23), 23);
  EXPECT_EQ(points(8), 8);
}

/// Two links of which nothing but the angle between them matters, in states of no particular order.
Dataset two_links(double noise) {
  Rng rng({.seed = 7});
  constexpr Index kSteps = 40;
  Episode episode{.actions = Matrix(kSteps, 1), .rewards = Vector::Zero(kSteps)};
  Matrix X(kSteps + 1, 3);
  X.row(0) << 0, 0.3, -0.5;
  for (Index t = 0; t < kSteps; ++t) {
    const double u = episode.actions(t, 0) = rng.uniform(-1, 1), turn = 0.5 * u + 0.2;
    X.row(t + 1) = X.row(t) + Eigen::RowVector3d(std::sin(X(t, 2) - X(t, 1)) + 0.3 * u, turn, 0.1 - 2 * turn);
  }
  episode.true_states = X;
  for (double& x : X.reshaped()) x += noise * rng.normal();
  episode.states = X;
  Dataset data;
  data.append(episode);
  return data;
}
Task two_link_task() {
  Task task = slider::task();
  task.states = {{"v", "m/s"}, {"a", "rad", StateKind::angle}, {"b", "rad", StateKind::angle, "", "a"}};
  return task;
}

// The last two features of a model with joint angles are cosine and sine of theirs, before the action.
TEST(Model, HasJointAnglesAsInputsWhereTheTaskNamesThem) {
  const Dataset data = two_links(0);
  ModelOptions options;
  const Model with = pilco::learn({two_link_task(), data, options, serial_evaluator()}, {});
  options.joint_angles = false;
  const Model without = pilco::learn({two_link_task(), data, options, serial_evaluator()}, {});
  ASSERT_TRUE(with.moments && without.moments);
  EXPECT_EQ(with.moments.gps->inputs(), 8);
  EXPECT_EQ(without.moments.gps->inputs(), 6);
  EXPECT_GT(with.log_evidence, without.log_evidence + 10);

  const moments::Gaussian known{Vector{{0.1, 0.4, -0.9}}, Matrix::Zero(3, 3)};
  moments::Gaussian inputs = moments::Gaussian::zero(8);
  inputs.mean << moments::FeatureMoments(moments::model_features(two_link_task(), true))(known).mean, 0.2;
  moments::MomentTape tape;
  moments::Transformed change = moments::Transformed::zero(8, 3);
  ASSERT_TRUE(with.moments.gps->forward(inputs, tape, change));
  Matrix mean(1, 3), variance(1, 3);
  with.model->predict(known.mean.transpose(), Matrix::Constant(1, 1, 0.2), mean, variance);
  EXPECT_LT((change.mean - mean.transpose()).norm(), 0.02) << "forecasts and searches have the same inputs";
}

// With so much measurement noise smoothing is likelier.
TEST(Model, SearchesAndForecastsLearnFromTheSameStatesSmoothedOrNot) {
  const Dataset data = two_links(0.05);
  const FeatureMap features = moments::model_features(two_link_task(), true);
  const Matrix inputs = dynamics::gp_inputs(features, data.states, data.actions);
  const auto learned = [&](const ModelOptions& options, const std::vector<moments::MomentTerm>& around) {
    Model model = pilco::learn({two_link_task(), data, options, serial_evaluator()}, {}, {.network = around});
    Matrix of_forecast(data.size(), 3);
    model.model->predict_mean(data.states, data.actions, of_forecast);
    const Matrix of_search = moments::evaluate_means(model.moments.gps->terms(), 3, inputs);
    EXPECT_LT((of_search - of_forecast).cwiseAbs().maxCoeff(), 2e-3);  // forecasts may be off by 0.01 σ_n
    return model;
  };
  ModelOptions options;
  const Model plain = learned(options, {});
  std::vector<moments::MomentTerm> half = moments::mean_terms(plain.moments.gps->terms());
  for (moments::MomentTerm& term : half) term.weights *= 0.5;
  learned(options, half);
  options.smooth = true;
  EXPECT_GT(learned(options, {}).log_evidence, plain.log_evidence + 0.15 * 3 * 40) << "it was smoothed";
  learned(options, half);
}

TEST(Model, CanBeInterruptedWhileItPlacesInducingInputs) {
  const Dataset data = asked_after(2, {{"search.line_searches", "5"}}).data;
  ModelOptions options;
  options.inducing = 8;
  const auto stop = [](const Progress&) { throw std::runtime_error("stopped"); };
  EXPECT_THROW(pilco::learn({task(), data, options, serial_evaluator(), stop}, {}), std::runtime_error);
}

TEST(Model, SurvivesDataThatTellNothing) {
  Dataset data;
  data.states = Matrix::Constant(3, 1, kNaN);
  data.actions = Matrix::Zero(3, 1);
  data.changes = data.states;
  data.rewards = Vector::Zero(3);
  const Model model = pilco::learn({task(), data, ModelOptions{}, serial_evaluator()}, {});
  EXPECT_FALSE(model.moments || model.model);
  ASSERT_EQ(model.notes.size(), 1U);
  EXPECT_NE(model.notes[0].find("the policy stays"), std::string::npos) << model.notes[0];
}

}  // namespace
}  // namespace rehearse::learners::pilco
