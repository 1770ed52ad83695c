#include "rehearse/identification/least_squares.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/dynamics/test/swing.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"
#include "rehearse/rollout/execute.hpp"

namespace rehearse::identification {
namespace {

Identified found(const Dataset& data, const prior::Prior& prior, const LeastSquares& options = {}) {
  return least_squares(dynamics::Residuals(data, swing::features()), prior, {}, options);
}

constexpr LeastSquares kPublished{.method = LeastSquares::Method::subplex};

TEST(LeastSquares, IsExactWithoutNoise) {
  const Identified exact = found(swing::data(25, 1), swing::prior({swing::length(), swing::friction()}));
  EXPECT_LT((exact.phi - swing::kTruth).norm(), 1e-10);
  EXPECT_LT(exact.evaluations, 60);
}

TEST(LeastSquares, HasThePublishedSearchToo) {
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const Identified published = found(swing::data(25, 1), prior, kPublished);
  EXPECT_NEAR(published.phi(0), 0.8, 1e-3);
  EXPECT_LE(published.evaluations, 2000);
}

/// The largest relative error of the masses and lengths after one episode of a random policy on the noise-free plant.
double pendubot_error(const scenario::Scenario& s, const scenario::NamedPrior& guess, std::uint64_t seed,
                      const LeastSquares& options) {
  Rng rng({.seed = seed, .purpose = Purpose::random_policy});
  const Vector theta = Vector::NullaryExpr(s.policy->parameters(), [&] { return rng.uniform(-5, 5); });
  Dataset data;
  data.append(rollout::execute(*s.make_plant(), *s.policy, theta, s.task, rng));
  const prior::Prior prior{guess.name, guess.simulator, guess.parameters};
  const dynamics::Residuals residuals(data, s.task.feature_map());
  return (least_squares(residuals, prior, {}, options).phi.head(4).array() - 0.5).abs().maxCoeff() / 0.5;
}

// Seeds 1 to 30; nothing but the policies is drawn.
TEST(LeastSquares, IdentifiesThePendubotFromOneEpisodeWithoutNoise) {
  const scenario::Scenario s = robots::pendubot::make({});
  for (const auto& guess : s.priors) {
    if (guess.name == "partial") continue;  // its frictions are wrong
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
      EXPECT_LT(pendubot_error(s, guess, seed, {}), 1e-6) << guess.name << " seed " << seed;
  }
}

TEST(LeastSquares, LeavesParametersAloneThatChangeNothing) {
  const prior::Prior prior =
      swing::prior({swing::length(), swing::friction(), Parameter::continuous("colour", 3, {1, 5})});
  EXPECT_EQ(found(swing::data(25, 1), prior).phi(2), 3);
}

// The length is rounded, so that the prior has no slope in it that differences could see: Subplex must.
TEST(LeastSquares, SearchesPriorsThatAreNotSmooth) {
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()},
                                          [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
                                            swing::ode(x, u, Vector{{std::round(phi(0) * 50) / 50, phi(1)}}, dxdt);
                                          });
  const Identified rounded = found(swing::data(25, 1), prior);
  EXPECT_NEAR(rounded.phi(0), 0.8, 0.0101);
  EXPECT_NEAR(rounded.phi(1), 0.3, 1e-3);
}

TEST(LeastSquares, RowsThatFailAreCharged) {
  const auto fragile = [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    swing::ode(x, u, phi, dxdt);
    if (phi(0) < 0.75 && std::abs(std::sin(x(1))) > 0.4) dxdt(0) = kNaN;
  };
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()}, fragile);
  const Identified survived = found(swing::data(60, 1), prior);  // starts at 0.5, where most rows fail
  EXPECT_LT((survived.phi - swing::kTruth).norm(), 1e-8);
  const prior::Prior always =
      swing::prior({swing::length(), swing::friction()},
                   [](const Vector&, const Vector&, const Vector&, Vector& dxdt) { dxdt.setConstant(kNaN); });
  EXPECT_EQ(found(swing::data(10, 1), always).phi, always.space.values());
}

TEST(LeastSquares, APhiAtWhichAllRowsFailIsNoneHoweverWrongThePriorIs) {
  const prior::Prior biased = swing::prior({swing::length(), swing::friction()},
                                           [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
                                             swing::ode(x, u, phi, dxdt);
                                             dxdt(0) += phi(0) > 1.2 ? kNaN : 1000;
                                           });
  for (const Index rows : {1, 25})
    for (const LeastSquares& options : {LeastSquares{}, kPublished})
      EXPECT_LE(found(swing::data(rows, 1), biased, options).phi(0), 1.2) << rows;
}

}  // namespace
}  // namespace rehearse::identification
