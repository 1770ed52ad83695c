#include "rehearse/identification/mirror_image.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"
#include "rehearse/dynamics/test/swing.hpp"

namespace rehearse::identification {
namespace {

/// Changes of the first state that follow `change` of the states and the action, with noise 0.01.
template <class Change>
double nats(const Matrix& states, Change change) {
  Rng rng({.seed = 1});
  Dataset data{states, Matrix::Zero(states.rows(), 1), Matrix::Zero(states.rows(), 2), Vector::Zero(states.rows())};
  for (Index i = 0; i < states.rows(); ++i) data.changes(i, 0) = change(states(i, 0)) + 0.01 * rng.normal();
  const Dataset both = with_images(data);
  const dynamics::Residuals residuals(both, FeatureMap({StateKind::plain, StateKind::plain}));
  gp::Hyperparameters kernel{.log_lengths = Vector::Zero(3), .log_signal = 0, .log_noise = std::log(0.01)};
  return nats_for_odd(residuals.at(nullptr, {}), {kernel, kernel}, {true, false});
}

/// States whose first is spread evenly between these.
Matrix between(double low, double high) {
  Matrix states = Matrix::Zero(30, 2);
  states.col(0) = Vector::LinSpaced(30, low, high);
  return states;
}

TEST(MirrorImage, ImagesHaveTheOppositeOfEverythingButTheReward) {
  const Dataset data{Matrix{{1, 2}}, Matrix{{3}}, Matrix{{4, 5}}, Vector{{6}}};
  const Dataset both = with_images(data);
  EXPECT_EQ(both.states, (Matrix{{1, 2}, {-1, -2}}));
  EXPECT_EQ(both.actions, (Matrix{{3}, {-3}}));
  EXPECT_EQ(both.changes, (Matrix{{4, 5}, {-4, -5}}));
  EXPECT_EQ(both.rewards, (Vector{{6, 6}}));
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

}  // namespace
}  // namespace rehearse::identification
