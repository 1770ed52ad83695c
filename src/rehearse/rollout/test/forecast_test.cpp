#include "rehearse/rollout/forecast.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "cart.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::rollout {
namespace {

Episode episode(Index steps) { return {.states = Matrix::Random(steps + 1, 2), .actions = Matrix::Random(steps, 1)}; }

/// The state `horizon` steps after step t, by hand.
Matrix from(const dynamics::DynamicsModel& model, const Episode& episode, Index t, Index horizon) {
  Matrix state = episode.states.row(t), change(1, 2), variance(1, 2);
  for (Index k = t; k < t + horizon; ++k) {
    model.predict(state, episode.actions.row(k), change, variance);
    state += change;
  }
  return state;
}

TEST(Forecast, ContinuesFromEveryStateUnderTheActionsTaken) {
  const cart::Model model(0.3);
  const Episode taken = episode(7);
  const std::vector<Index> horizons = {1, 2, 5, 7};
  const std::vector<Matrix> predicted = forecast(model, taken, horizons);
  ASSERT_EQ(predicted.size(), horizons.size());
  for (std::size_t i = 0; i < horizons.size(); ++i) {
    ASSERT_EQ(predicted[i].rows(), 8 - horizons[i]);
    for (Index t = 0; t < predicted[i].rows(); ++t)
      EXPECT_LT((predicted[i].row(t) - from(model, taken, t, horizons[i])).norm(), 1e-14) << horizons[i] << " " << t;
  }
  EXPECT_TRUE(forecast(model, taken, {}).empty());
}

TEST(Forecast, WhatFailsStaysNanInItsRowAndIsNoInputForTheModel) {
  /// Cannot predict from positions beyond 0.
  class Spoilt final : public dynamics::DynamicsModel {
   public:
    void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
                 MatrixView variance) const override {
      EXPECT_TRUE(X.allFinite());
      model_.predict(X, U, mean, variance);
    }

   private:
    cart::Model model_{0, [](double, double position) { return position > 0; }};
  };
  Episode taken = episode(4);
  taken.states.col(0).setZero();
  taken.states.col(1) << -1, 1, -1, -1, -1;
  taken.actions.setZero();
  const std::vector<Matrix> predicted = forecast(Spoilt(), taken, {1, 2, 3});
  for (const Matrix& states : predicted)
    for (Index t = 0; t < states.rows(); ++t)
      EXPECT_TRUE(t == 1 ? states.row(t).array().isNaN().all() : states.row(t) == taken.states.row(t)) << t;
}

TEST(Forecast, HorizonsOutsideTheEpisodeAreRefused) {
  for (const std::vector<Index>& horizons : {std::vector<Index>{0}, {5}, {2, 1}})
    EXPECT_THROW(forecast(cart::Model(), episode(4), horizons), InvalidInput);
}

TEST(Follow, LeadsEveryRowWhereThePolicyDoes) {
  const cart::Model model(0.3);
  const Task task = cart::task();
  const auto policy = cart::policy();
  const Vector theta = cart::candidates(1).col(0);
  const Matrix from = Matrix::Random(150, 2);
  const Matrix to = follow(model, task, {*policy, theta}, from, 5),
               other = follow(model, task, {*policy, theta}, from, 5, *make_thread_evaluator(3));
  EXPECT_EQ(to, other);
  Matrix state = from.row(140), action(1, 1), change(1, 2), variance(1, 2);
  for (int t = 0; t < 5; ++t) {
    policy->act(theta.transpose(), state, 0.1 * t, action);
    model.predict(state, action, change, variance);
    state += change;
  }
  EXPECT_LT((to.row(140) - state).norm(), 1e-13) << "the variance adds nothing";
}

TEST(Follow, WhatFailsIsNanInItsRowAlone) {
  const cart::Model model(0, [](double, double position) { return position > 0; });
  const auto policy = cart::policy();
  const Vector theta = cart::candidates(1).col(0);
  const Matrix to = follow(model, cart::task(), {*policy, theta}, Matrix{{0, -5}, {0, 1}, {0, -6}}, 3);
  EXPECT_TRUE(to.row(0).allFinite() && to.row(2).allFinite());
  EXPECT_TRUE(to.row(1).array().isNaN().all());
}

}  // namespace
}  // namespace rehearse::rollout
