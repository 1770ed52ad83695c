// Parameters of which the equations hold combinations alone.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rehearse/dynamics/test/double_pendulum.hpp"
#include "rehearse/dynamics/test/swing.hpp"
#include "rehearse/identification/identifiability.hpp"
#include "rehearse/identification/learn.hpp"
#include "rehearse/identification/phi_posterior.hpp"

namespace rehearse::identification {
namespace {

/// The prior whose changes are rounded, as those of a program that prints so many digits.
prior::Prior rounded(const prior::Prior& prior, double unit) {
  class Rounded final : public system::Simulator {
   public:
    Rounded(std::shared_ptr<const system::Simulator> exact, double unit) : exact_(std::move(exact)), unit_(unit) {}
    const ParameterSpace& parameters() const override { return exact_->parameters(); }
    void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const override {
      exact_->change(X, U, phi, dX);
      dX = (dX / unit_).array().round() * unit_;
    }

   private:
    const std::shared_ptr<const system::Simulator> exact_;
    const double unit_;
  };
  return {prior.name, std::make_shared<Rounded>(prior.simulator, unit), prior.space};
}

void expect_to_hold_the_double_pendulum(const PhiPosterior& posterior, const std::string& label) {
  const auto intervals = posterior.intervals();
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const double truth = double_pendulum::kTruth(static_cast<Index>(i));
    EXPECT_TRUE(intervals[i].low <= truth && truth <= intervals[i].high)
        << label << ": " << truth << " not in " << intervals[i].low << " to " << intervals[i].high;
  }
}

// Four parameters of which three combinations are in the equations, 50 steps without noise, seeds 1 to 4 (GP-MI: 1 and
// 2): the intervals are all of the ridge in the box, its ends r2 = 0.5, where m2 = 0.209, and I1 = 0.01.
TEST(PhiPosterior, OnAnExactRidgeIntervalsHoldTheTruthAndTheKnownIsNamed) {
  const prior::Prior prior = double_pendulum::prior();
  const Dataset other = double_pendulum::episode(50, 100);
  for (const Kind& kind : {Kind(Mi{}), Kind(GpMi{})})
    for (std::uint64_t seed = 1; seed <= (kind.index() == Kind(Mi{}).index() ? 4 : 2); ++seed) {
      const Dataset data = double_pendulum::episode(50, seed);
      const auto learned = learn({data, double_pendulum::features(), double_pendulum::kinematics(), &prior}, kind, {},
                                 serial_evaluator());
      const std::string label = fmt::format("{} seed {}", kind.index(), seed);
      expect_to_hold_the_double_pendulum(*learned.posterior, label);
      const Interval m2 = learned.posterior->intervals()[1];
      EXPECT_TRUE(m2.low < 0.22 && m2.high > 1.11) << label << ": " << m2.low << " to " << m2.high;
      EXPECT_EQ(identifiability_warnings(*learned.posterior),
                std::vector<std::string>{
                    "m1, m2, r2 and I1 cannot be told apart by these data; known are m1 + m2 = 1.24, r2·m2 = "
                    "0.105 and I1 + 0.09·m2 = 0.111"})
          << label;
      Matrix mean(other.size(), 4), variance(other.size(), 4);
      learned.model->predict(other.states, other.actions, mean, variance);
      EXPECT_LT(swing::rms(mean - other.changes), 1e-5 * swing::rms(other.changes)) << "policies do not suffer";
    }
}

// Rounding hides the ridge from differences, and its information is theirs. Seeds 1 and 2.
TEST(PhiPosterior, WhatDifferencesCannotResolveIsNotKnown) {
  for (const double unit : {1e-9, 1e-6}) {
    const prior::Prior prior = rounded(double_pendulum::prior(), unit);
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Dataset data = double_pendulum::episode(50, seed);
      const auto learned = learn({data, double_pendulum::features(), double_pendulum::kinematics(), &prior}, Mi{}, {},
                                 serial_evaluator());
      expect_to_hold_the_double_pendulum(*learned.posterior, fmt::format("unit {} seed {}", unit, seed));
    }
  }
}

}  // namespace
}  // namespace rehearse::identification
