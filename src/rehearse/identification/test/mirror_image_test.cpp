#include "rehearse/identification/mirror_image.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "learn_swing.hpp"
#include "rehearse/core/random.hpp"

namespace rehearse::identification {
namespace {

/// The nats of an output that follows `change` of the first state, with noise 0.01; both outputs are the same.
template <class Change>
double nats(const Matrix& states, Change change) {
  Rng rng({.seed = 1});
  const Index n = states.rows();
  Dataset data{.states = states, .actions = Matrix::Zero(n, 1), .changes = Matrix::Zero(n, 2), .rewards = {}};
  for (Index i = 0; i < n; ++i) data.changes.row(i).setConstant(change(states(i, 0)) + 0.01 * rng.normal());
  const dynamics::Residuals residuals(data, FeatureMap({StateKind::plain, StateKind::plain}));
  const gp::Hyperparameters kernel{.log_lengths = Vector::Zero(3), .log_signal = 0, .log_noise = std::log(0.01)};
  const dynamics::Residuals::Rows rows = residuals.at(nullptr, {});
  Fit fit = unfitted({}, 2, {kernel, kernel});
  gp::Workspace workspace;
  fit.log_evidences = Vector::Zero(2);
  for (Index e = 0; e < 2; ++e)
    fit.log_evidences(e) = gp::evidence(*rows.inputs, data.changes.col(e), kernel.flat(), workspace).value;
  return nats_for_odd(residuals, rows, fit) / 2;
}

/// States whose first is spread evenly between these.
Matrix between(double low, double high) {
  Matrix states = Matrix::Zero(30, 2);
  states.col(0) = Vector::LinSpaced(30, low, high);
  return states;
}

TEST(MirrorImage, CosinesStayAndAllElseChangesItsSign) {
  const FeatureMap features({StateKind::plain, StateKind::omitted, StateKind::angle, StateKind::angle}, {{3, 2}});
  EXPECT_EQ(signs_of_images(features, 1), (Vector{{-1, 1, -1, 1, -1, 1, -1, -1}}));
  Matrix X{{0.3, 5, 0.7, -2}}, F(1, features.features()), image = F;
  features.apply(X, F);
  features.apply(-X, image);
  EXPECT_EQ(image, F * signs_of_images(features, 0).asDiagonal());
}

// An odd function is smooth in itself, but it is known from half as many places: each that has an image tells twice.
TEST(MirrorImage, OddFunctionsAreFoundWhereRowsMeetTheirImages) {
  EXPECT_GT(nats(between(-2, 2), [](double x) { return std::sin(2 * x); }), 10);
  EXPECT_LT(nats(between(-2, 2), [](double x) { return std::cos(2 * x); }), -1000);
  EXPECT_LT(nats(between(-2, 2), [](double x) { return std::sin(2 * x) + 0.1; }), -10);
}

TEST(MirrorImage, RowsFarFromAllImagesTellNothing) {
  EXPECT_NEAR(nats(between(5, 9), [](double x) { return std::sin(2 * x); }), 0, 1e-6);
  EXPECT_NEAR(nats(between(5, 9), [](double x) { return std::cos(2 * x); }), 0, 1e-6);
}

// By hand: one row at x has the variance σ_f² (1 − exp(−2 x²)) + σ_n² of an odd function instead of σ_f² + σ_n².
TEST(MirrorImage, OneRowIsAsByHand) {
  Matrix state{{0.5, 0}};
  const double y = nats(state, [](double) { return 0.3; });
  Rng rng({.seed = 1});
  const double change = 0.3 + 0.01 * rng.normal();
  const auto log_density = [&](double variance) { return -0.5 * (change * change / variance + std::log(variance)); };
  EXPECT_NEAR(y, log_density(1 - std::exp(-0.5) + 1e-4) - log_density(1 + 1e-4), 1e-12);
}

// Rows on one side of the hanging pendulum tell of the other side.
TEST(LearnedMirrorImage, ARobotThatIsItsMirrorImageIsLearnedFromOneSide) {
  Dataset data = swing::data(200, 1), held_out = swing::data(200, 2);
  const auto keep = [](Dataset& of, auto side) {
    std::vector<Index> rows;
    for (Index i = 0; i < of.size(); ++i)
      if (side(std::sin(of.states(i, 1)))) rows.push_back(i);
    of = {Matrix(of.states(rows, Eigen::all)), Matrix(of.actions(rows, Eigen::all)),
          Matrix(of.changes(rows, Eigen::all)), Vector()};
  };
  keep(data, [](double sine) { return sine > 0; });
  keep(held_out, [](double sine) { return sine < 0; });
  ASSERT_GT(held_out.size(), 50);
  ZeroMean plain, mirrored;
  plain.gp.mirror = dynamics::Mirror::off;
  mirrored.gp.mirror = dynamics::Mirror::on;
  const Learned one_side = learn_swing(data, plain), both_sides = learn_swing(data, mirrored);
  EXPECT_LT(error(*both_sides.model, held_out), 0.03 * swing::rms(held_out.changes));
  EXPECT_GT(error(*one_side.model, held_out), 3 * error(*both_sides.model, held_out));
}

TEST(LearnedMirrorImage, DataTellWhetherARobotIsItsMirrorImage) {
  ZeroMean asks;
  ASSERT_EQ(asks.gp.mirror, dynamics::Mirror::automatic);
  Dataset data = swing::data(60, 1);
  const std::string found =
      "the data are likelier of a robot that is its own mirror image: it is learned as one from now on";
  const Learned first = learn_swing(data, asks);
  EXPECT_EQ(first.notes, std::vector<std::string>{found});
  EXPECT_TRUE(first.state.odd);
  EXPECT_EQ(learn_swing(data, asks, nullptr, first.state).notes, std::vector<std::string>{}) << "said once";
  const auto told = [&](const Kind& kind) { return error(*learn_swing(data, kind).model, swing::data(200, 2)); };
  ZeroMean on, off;
  on.gp.mirror = dynamics::Mirror::on;
  off.gp.mirror = dynamics::Mirror::off;
  EXPECT_EQ(told(asks), told(on));
  data.changes.col(0).array() += 0.05;  // a motor that pulls to one side
  EXPECT_EQ(learn_swing(data, asks).notes, std::vector<std::string>{});
  EXPECT_EQ(told(asks), told(off));
  EXPECT_EQ(
      learn_swing(data, asks, nullptr, first.state).notes,
      std::vector<std::string>{"the data no longer say that the robot is its own mirror image: it is learned without"});
}

// Around a prior that leans as the robot does, what is left may be odd, but the robot is not.
TEST(LearnedMirrorImage, APriorThatIsNotItsMirrorImageAsksNoData) {
  Dataset data = swing::data(60, 1);
  FixedPrior asks;
  asks.gp.mirror = dynamics::Mirror::automatic;
  const auto leaning = [](double push) {
    return swing::prior({}, [push](const Vector& x, const Vector& u, const Vector&, Vector& dxdt) {
      swing::ode(x, u, Vector{{1.2, 0.1}}, dxdt);
      dxdt(0) += push;
    });
  };
  const prior::Prior symmetric = leaning(0), leans = leaning(0.5);
  EXPECT_EQ(learn_swing(data, asks, &symmetric).notes.size(), 1u);
  data.changes.col(0).array() += 0.05;  // what the push does in a step
  EXPECT_EQ(learn_swing(data, asks, &leans).notes, std::vector<std::string>{});
}

TEST(LearnedMirrorImage, APriorThatIsNotItsMirrorImageIsSaid) {
  const Dataset data = swing::data(40, 1);
  FixedPrior mirrored;
  mirrored.gp.mirror = dynamics::Mirror::on;
  const prior::Prior symmetric = swing::prior_at(swing::kTruth);
  EXPECT_EQ(learn_swing(data, mirrored, &symmetric).notes, std::vector<std::string>{});
  const prior::Prior leaning = swing::prior({}, [](const Vector& x, const Vector& u, const Vector&, Vector& dxdt) {
    swing::ode(x, u, swing::kTruth, dxdt);
    dxdt(0) += 0.5;
  });
  const std::vector<std::string> notes = learn_swing(data, mirrored, &leaning).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("not its own mirror image: the change of dtheta differs by 0.1"), std::string::npos)
      << notes[0];
  EXPECT_EQ(learn_swing(data, FixedPrior{}, &leaning).notes, std::vector<std::string>{});
}

TEST(LearnedMirrorImage, StepsThatContradictTheMirrorImageAreSaid) {
  ZeroMean mirrored;
  mirrored.gp.mirror = dynamics::Mirror::on;
  Dataset data = swing::data(100, 1);
  EXPECT_EQ(learn_swing(data, mirrored).notes, std::vector<std::string>{});
  data.changes.col(0).array() += 0.2;  // a motor that pulls to one side
  const std::vector<std::string> notes = learn_swing(data, mirrored).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("measured steps contradict it: dtheta errs by "), std::string::npos) << notes[0];
  EXPECT_EQ(learn_swing(data, ZeroMean{}).notes, std::vector<std::string>{});
}

TEST(LearnedMirrorImage, StepsThatContradictItAreSaidWhereThePriorFailsAtOthers) {
  FixedPrior mirrored;
  mirrored.gp.mirror = dynamics::Mirror::on;
  Dataset data = swing::data(100, 1);
  data.changes.col(0).array() += 0.2;
  const double far = 0.9 * data.actions.cwiseAbs().maxCoeff();
  const auto fails = [far](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    swing::ode(x, u, phi, dxdt);
    if (std::abs(u(0)) > far) dxdt(0) = kNaN;
  };
  const prior::Prior prior = swing::prior({swing::length(0.3), swing::friction()}, fails);
  const auto learned = learn_swing(data, mirrored, &prior);
  EXPECT_GT(learned.left_out_rows, 0);
  ASSERT_EQ(learned.notes.size(), 1u);
  EXPECT_NE(learned.notes[0].find("measured steps contradict it: dtheta errs by "), std::string::npos)
      << learned.notes[0];
}

}  // namespace
}  // namespace rehearse::identification
