#include "rehearse/identification/misfit.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse::identification {
namespace {

/// n inputs spread evenly over [−1, 1], with a value for each.
struct Line {
  Matrix X;
  Vector y;

  Line(Index n, double wave, double noise) : X(n, 1), y(n) {
    Rng rng({.seed = 5});
    for (Index i = 0; i < n; ++i) {
      X(i, 0) = 2.0 * static_cast<double>(i) / static_cast<double>(n - 1) - 1;
      y(i) = wave * std::sin(3 * X(i, 0)) + noise * rng.normal();
    }
  }
};

TEST(Misfit, NearestRowsAreNeighboursOnALine) {
  const Line line(5, 1, 0);
  EXPECT_EQ(nearest_rows(gp::Inputs(line.X)), (std::vector<Index>{1, 0, 1, 2, 3}));
}

// 400 values: their mean square is 1 within 0.35 (five deviations); the wave's is 0.52.
TEST(Misfit, OfWhiteNoiseIsNearNothingAndOfAWaveIsItsMeanSquare) {
  const Line white(400, 0, 1), both(400, 1, 0.1);
  const auto misfit = [](const Line& line) {
    return spread_of_white(line.y, 1, 1, nearest_rows(gp::Inputs(line.X))).misfit;
  };
  EXPECT_LT(misfit(white), 0.3);
  EXPECT_NEAR(misfit(both), 0.52, 0.05);
}

TEST(Misfit, OfAGpIsWhatItPredictsFromOtherRows) {
  const gp::Hyperparameters kernel = gp::Hyperparameters::from_flat(Vector{{std::log(0.5), 0, std::log(0.1)}}, 1);
  const Line both(60, 1, 0.1), white(60, 0, 0.1);
  const Spread wave = spread_of_gp(gp::Inputs(both.X), kernel, both.y);
  EXPECT_GT(wave.misfit, 20 * spread_of_gp(gp::Inputs(white.X), kernel, white.y).misfit);
  EXPECT_EQ(wave.whiten(both.y).rows(), 60);
  EXPECT_LT((wave.explained - Line(60, 1, 0).y).norm() / std::sqrt(60), 0.06) << "the noise, 0.1, is not explained";
}

}  // namespace
}  // namespace rehearse::identification
