#include "rehearse/rollout/particles.hpp"

#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::rollout {
namespace {

/// x moves by u and by noise of deviation 0.1; beyond 100 it has no prediction.
class Drift final : public dynamics::DynamicsModel {
 public:
  explicit Drift(Index rows_at_once = 0) : rows_at_once_(rows_at_once) {}

  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
               MatrixView variance) const override {
    ++calls;
    mean = U;
    for (Index i = 0; i < X.rows(); ++i)
      if (X(i, 0) > 100) mean(i, 0) = std::nan("");
    variance.setConstant(0.01);
  }
  Index rows_at_once() const override { return rows_at_once_; }
  mutable std::atomic<Index> calls = 0;

 private:
  Index rows_at_once_;
};

Episode ramp(Index steps) {
  Episode episode;
  episode.states = Vector::LinSpaced(steps + 1, 0, static_cast<double>(steps));
  episode.actions = Matrix::Ones(steps, 1);
  return episode;
}

TEST(Particles, CarryTheUncertaintyOfTheModelAndOfTheStart) {
  const Journeys journeys{{0, 3, 18}, {1, 4}, 4000, Vector{{0.3}}};
  const auto arrived = forecast_particles(Drift(), ramp(20), journeys, {.seed = 5}, serial_evaluator());
  const auto of = [&](std::size_t horizon, Index start) { return arrived[horizon].middleRows(4000 * start, 4000); };
  EXPECT_NEAR(of(0, 0).mean(), 1, 0.03);
  EXPECT_NEAR(of(1, 1).mean(), 7, 0.03);
  EXPECT_NEAR((of(1, 1).array() - 7).square().mean(), 0.09 + 4 * 0.01, 0.013);  // four standard errors
  EXPECT_TRUE(of(1, 2).array().isNaN().all());                                  // beyond the episode's end
}

TEST(Particles, DependOnStartAndNumberAlone) {
  const auto one = forecast_particles(Drift(), ramp(20), {{7}, {2}, 5, {}}, {.seed = 5}, serial_evaluator());
  const auto many =
      forecast_particles(Drift(), ramp(20), {{1, 2, 3, 4, 7}, {1, 2}, 5, {}}, {.seed = 5}, *make_thread_evaluator(2));
  EXPECT_EQ(one[0], many[1].bottomRows(5));
}

TEST(Particles, AModelWhoseCallsAreDearIsCalledOnceAStep) {
  const Journeys journeys{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {4}, 5, {}};
  const Drift dear(1000), cheap;
  const auto arrived = forecast_particles(dear, ramp(20), journeys, {.seed = 5}, serial_evaluator());
  EXPECT_EQ(arrived, forecast_particles(cheap, ramp(20), journeys, {.seed = 5}, serial_evaluator()));
  EXPECT_EQ(dear.calls, 4);
  EXPECT_EQ(cheap.calls, 3 * 4);  // of four starts each
}

TEST(Particles, WhatFailsStaysFailed) {
  const auto arrived = forecast_particles(Drift(), ramp(110), {{98, 101}, {1, 8}, 2, {}}, {}, serial_evaluator());
  EXPECT_TRUE(arrived[0].topRows(2).allFinite());
  EXPECT_TRUE(arrived[0].bottomRows(2).array().isNaN().all());
  EXPECT_TRUE(arrived[1].array().isNaN().all());
}

TEST(Particles, WrongJourneysAreRefused) {
  for (const Journeys& wrong : {Journeys{{20}, {1}, 1, {}}, Journeys{{0}, {2, 1}, 1, {}}, Journeys{{0}, {0}, 1, {}},
                                Journeys{{0}, {1}, 0, {}}, Journeys{{0}, {1}, 1, Vector::Zero(2)}})
    EXPECT_THROW(forecast_particles(Drift(), ramp(20), wrong, {}, serial_evaluator()), InvalidInput);
}

}  // namespace
}  // namespace rehearse::rollout
