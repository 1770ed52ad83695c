#include "rehearse/system/simulated_plant.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::system {
namespace {

const StartAndSensors kStill{Vector{{1, 0}}, Vector{{0, 0}}, {}};

/// A step of a rotation that the action speeds up.
Vector turned(const Vector& x, const Vector& u) { return Vector{{x(0) - 0.1 * x(1), x(1) + 0.1 * x(0) + u(0)}}; }

TEST(SimulatedPlant, WrongSizesAndAStepBeforeTheStartAreRefused) {
  try {
    make_simulated_plant(turned, {Vector{{1, 0}}, Vector{{0}}, Vector{{1, 1, 1}}});
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.violations().size(), 2u) << error.what();
  }
  EXPECT_THROW(make_simulated_plant(turned, kStill)->step(Vector{{0}}), std::logic_error);
}

// Seed 1, n = 4000 measurements: the standard deviation of their noise is within 5 √(1/2n) = 5.6 % with probability
// 1 − 6e-7, the mean within 5 deviations of 0.
TEST(SimulatedPlant, MeasurementsAreNoisyAndTheTruthIsNot) {
  StartAndSensors noisy = kStill;
  noisy.measurement_std = Vector{{0.1, 0.3}};
  const auto plant = make_simulated_plant(turned, noisy), clean = make_simulated_plant(turned, kStill);
  Rng rng({.seed = 1}), other({.seed = 2});
  plant->reset(rng);
  clean->reset(other);
  constexpr Index n = 4000;
  Matrix errors(n, 2);
  for (Index t = 0; t < n; ++t) {
    const Vector measured = plant->step(Vector{{0}});
    clean->step(Vector{{0}});
    errors.row(t) = (measured - plant->truth()).transpose();
    ASSERT_EQ(plant->truth(), clean->truth()) << "noise of measurement does not move the robot";
  }
  for (Index i = 0; i < 2; ++i) {
    const double deviation = std::sqrt(errors.col(i).squaredNorm() / n);
    EXPECT_NEAR(deviation, noisy.measurement_std(i), 0.056 * noisy.measurement_std(i));
    EXPECT_LT(std::abs(errors.col(i).mean()), 5 * noisy.measurement_std(i) / std::sqrt(n));
  }
}

// Seeds 1..2000; bounds as above, 5 √(1/4000) = 7.9 %.
TEST(SimulatedPlant, TheStartIsDrawnFromTheRng) {
  StartAndSensors options = kStill;
  options.start_std = Vector{{0.2, 0}};
  const auto plant = make_simulated_plant(turned, options);
  double sum = 0, squares = 0;
  constexpr int n = 2000;
  for (std::uint64_t seed = 1; seed <= n; ++seed) {
    Rng rng({.seed = seed});
    const Vector start = plant->reset(rng);
    EXPECT_EQ(start(1), 0);
    sum += start(0) - 1, squares += (start(0) - 1) * (start(0) - 1);
  }
  EXPECT_LT(std::abs(sum / n), 5 * 0.2 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.2, 0.079 * 0.2);
}

}  // namespace
}  // namespace rehearse::system
