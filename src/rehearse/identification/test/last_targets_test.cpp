#include "rehearse/identification/last_targets.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "rehearse/dynamics/test/double_pendulum.hpp"
#include "rehearse/dynamics/test/swing.hpp"
#include "rehearse/identification/least_squares.hpp"
#include "rehearse/identification/phi_posterior.hpp"

namespace rehearse::identification {
namespace {

/// The prior, which writes down each φ that it is asked at.
prior::Prior written_down(const prior::Prior& prior, std::vector<Vector>& asked) {
  const auto change = [exact = prior.simulator, &asked](const ConstMatrixView& X, const ConstMatrixView& U,
                                                        const Vector& phi, MatrixView dX) {
    asked.push_back(phi);
    exact->change(X, U, phi, dX);
  };
  return {prior.name, system::make_simulator(prior.simulator->parameters(), change), prior.space};
}

bool no_two_in_a_row(const std::vector<Vector>& asked) {
  return std::adjacent_find(asked.begin(), asked.end()) == asked.end();
}

TEST(LastTargets, AreKeptUntilAnotherPhiIsAsked) {
  std::vector<Vector> asked;
  const prior::Prior prior = written_down(swing::prior({swing::length(), swing::friction()}), asked);
  const Dataset data = swing::data(10, 1);
  const dynamics::Residuals residuals(data, swing::features());
  LastTargets targets(residuals, prior);
  const Vector other{{0.7, 0.2}};
  for (const Vector& phi : {swing::kTruth, swing::kTruth, other, other, swing::kTruth}) {
    const Matrix found = targets.at(phi);
    const Index evaluations = static_cast<Index>(asked.size());
    EXPECT_EQ(targets.evaluations(), evaluations);
    EXPECT_EQ(found, residuals.targets(&prior, phi));
    asked.resize(static_cast<std::size_t>(evaluations));
  }
  EXPECT_EQ(asked, (std::vector<Vector>{swing::kTruth, other, swing::kTruth}));
}

TEST(LastTargets, OfLeastSquaresAreNotAskedAgainForDerivatives) {
  std::vector<Vector> asked;
  const prior::Prior prior = written_down(swing::prior({swing::length(), swing::friction()}), asked);
  const Dataset data = swing::data(25, 1);
  const Identified found = least_squares(dynamics::Residuals(data, swing::features()), prior, {}, {});
  EXPECT_LT((found.phi - swing::kTruth).norm(), 1e-10);
  EXPECT_EQ(found.evaluations, static_cast<Index>(asked.size()));
  EXPECT_TRUE(no_two_in_a_row(asked));
}

// Three combinations of four parameters are known, so that the fourth direction is followed.
TEST(LastTargets, OfTheWayAlongAValleyAreNotAskedAgainForDerivatives) {
  std::vector<Vector> asked;
  const prior::Prior prior = written_down(double_pendulum::prior(), asked);
  const Dataset data = double_pendulum::episode(50, 1);
  const dynamics::Residuals residuals(data, double_pendulum::features(), double_pendulum::kinematics());
  const auto posterior = phi_posterior(residuals, prior, double_pendulum::kTruth, 2, serial_evaluator());
  ASSERT_TRUE(posterior && posterior->unknown_directions == 1);
  EXPECT_TRUE(no_two_in_a_row(asked));
}

}  // namespace
}  // namespace rehearse::identification
