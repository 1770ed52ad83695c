#include "rehearse/policy/gait.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/testing/check_policy.hpp"

namespace rehearse::policy {
namespace {

/// The signal by its definition: a window slid over 100 samples.
double by_definition(double amplitude, double phase, double duty, int now) {
  double raw[100], sum = 0, weights = 0;
  for (int i = 0; i < 100; ++i) raw[i] = i < static_cast<int>(100 * duty) ? amplitude : -amplitude;
  const int middle = now + static_cast<int>(100 * phase);
  for (int d = -10; d <= 10; ++d) {
    const double weight = std::exp(-d * d / 18.0);
    sum += weight * raw[(middle + d + 200) % 100];
    weights += weight;
  }
  return sum / weights;
}

TEST(Gait, SignalIsASmoothedSquareWave) {
  Rng rng({.purpose = Purpose::test});
  for (int i = 0; i < 500; ++i) {
    const double amplitude = rng.uniform(0, 1), phase = rng.uniform(0, 1), duty = rng.uniform(0, 1);
    const int now = static_cast<int>(rng.uniform(0, 400));
    EXPECT_NEAR(gait_signal(amplitude, phase, duty, 0.01 * now), by_definition(amplitude, phase, duty, now % 100),
                1e-12)
        << amplitude << " " << phase << " " << duty << " " << now;
  }
  EXPECT_EQ(gait_signal(1, 0.3, 0, 0.2), -1);
  EXPECT_EQ(gait_signal(1, 0.3, 1, 0.2), 1);
  EXPECT_EQ(gait_signal(1, 1, 0.5, 0.2), gait_signal(1, 0, 0.5, 0.2));
}

Task six_legs() {
  Task task;
  task.states = {{"x", "m"}};
  for (Index i = 0; i < 18; ++i)
    task.actions.push_back({"a", "rad", {-std::numbers::pi / (i % 3 ? 4 : 8), std::numbers::pi / (i % 3 ? 4 : 8)}});
  task.start_mean = task.start_std = Vector::Zero(1);
  task.dt_s = 0.1;
  task.horizon = 40;
  return task;
}

TEST(Gait, KeepsTheLaws) {
  const auto gait = make_gait(6);
  EXPECT_EQ(gait->parameters(), 36);
  const auto broken = testing::check_policy(*gait, six_legs());
  EXPECT_TRUE(broken.empty()) << broken.front();
}

TEST(Gait, TibiasStayVerticalAndTripodsAlternate) {
  const auto gait = make_gait(6);
  const Matrix Theta = tripod_gait().transpose(), X = Matrix::Zero(1, 1);
  Matrix U(1, 18);
  for (const double t : {0.0, 0.2, 0.5, 3.7}) {
    gait->act(Theta, X, t, U);
    for (Index leg = 0; leg < 6; ++leg) EXPECT_EQ(U(0, 3 * leg + 2), -U(0, 3 * leg + 1));
    EXPECT_EQ(U(0, 1), U(0, 7)) << "rear-left with front-left";
    EXPECT_EQ(U(0, 1), U(0, 13)) << "and mid-right";
    EXPECT_NEAR(U(0, 1), -U(0, 4), 0.1) << "against mid-left";
  }
}

TEST(Gait, NeedsALeg) { EXPECT_THROW(make_gait(0), InvalidInput); }

}  // namespace
}  // namespace rehearse::policy
