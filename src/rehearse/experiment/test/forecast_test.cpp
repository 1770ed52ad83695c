#include "rehearse/experiment/forecast.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "fake.hpp"

namespace rehearse::experiment {
namespace {

/// x moves by 0.1 u, with u = 1, from 0.
Episode steady_episode(Index steps) {
  Episode episode;
  episode.states = Vector::LinSpaced(steps + 1, 0, 0.1 * static_cast<double>(steps));
  episode.true_states = episode.states;
  episode.actions = Matrix::Ones(steps, 1);
  episode.rewards = Vector::Zero(steps);
  return episode;
}

TEST(Forecast, ErrorGrowsByTheModelsErrorPerStep) {
  const auto errors = forecast_errors(fake::LineModel(1.5), fake::line_task(), steady_episode(12));
  const std::vector<Index> horizons = {1, 2, 5, 10};
  ASSERT_EQ(errors.size(), horizons.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_EQ(errors[i].horizon, horizons[i]);
    EXPECT_EQ(errors[i].compared, 13 - horizons[i]);
    EXPECT_EQ(errors[i].failed, 0);
    EXPECT_NEAR(errors[i].rms(0), 0.05 * static_cast<double>(horizons[i]), 1e-12);
  }
}

/// Cannot predict beyond 0.55.
class ShortSighted final : public dynamics::DynamicsModel {
 public:
  void predict(const ConstMatrixView& X, const ConstMatrixView&, MatrixView mean, MatrixView variance) const override {
    EXPECT_TRUE(X.allFinite());
    mean = (X.array() > 0.55).select(Matrix::Constant(X.rows(), 1, std::nan("")), 0.1);
    variance.setZero();
  }
};

TEST(Forecast, FailedPredictionsAreCountedAndLeftOut) {
  const auto errors = forecast_errors(ShortSighted(), fake::line_task(), steady_episode(12));
  EXPECT_EQ(errors[0].compared, 6);
  EXPECT_EQ(errors[0].failed, 6);
  EXPECT_NEAR(errors[0].rms(0), 0, 1e-12);
  EXPECT_EQ(errors[3].compared, 0);
  EXPECT_TRUE(std::isnan(errors[3].rms(0)));
}

TEST(Forecast, AnglesDifferByLessThanATurn) {
  Task task = fake::line_task();
  task.states[0].kind = StateKind::angle;
  Episode episode = steady_episode(1);
  episode.states(1, 0) += 2 * std::numbers::pi;
  EXPECT_NEAR(forecast_errors(fake::LineModel(1), task, episode)[0].rms(0), 0, 1e-12);
}

}  // namespace
}  // namespace rehearse::experiment
