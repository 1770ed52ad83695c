#include "rehearse/learners/ite/adaptation.hpp"

#include <cmath>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse::learners::ite {
namespace {

Matrix line(Index n) { return Vector::LinSpaced(n, 0, 1).transpose(); }

TEST(Adaptation, BeginsWithThePromiseOfTheArchive) {
  const Adaptation a(line(3), Vector{{0.2, 0.9, 0.5}}, {});
  EXPECT_EQ(a.next(), 1);
  EXPECT_EQ(a.means(), (Vector{{0.2, 0.9, 0.5}}));
  EXPECT_EQ(a.deviations(), Vector::Ones(3));
  EXPECT_EQ(a.stopped(), "");
}

// Two trials, against the formulas with a 2 × 2 matrix inverted by hand.
TEST(Adaptation, IsAGaussianProcessAboutThePromise) {
  const Vector promised{{0.2, 0.9, 0.5, 0.6}};
  const Matrix descriptors{{0, 0.3, 0.5, 0.9}, {0.1, 0.1, 0.6, 0}};
  Adaptation a(descriptors, promised, {.signal_variance = 2, .noise_variance = 0.1, .stop_ratio = 0});
  a.observe(1, 0.3);
  a.observe(3, 0.7);
  const auto k = [&](Index i, Index j) {
    const double s = std::sqrt(5) * (descriptors.col(i) - descriptors.col(j)).norm() / 0.4;
    return 2 * (1 + s + s * s / 3) * std::exp(-s);
  };
  const double diagonal = 2.1, off = k(1, 3), determinant = diagonal * diagonal - off * off;
  for (Index i = 0; i < 4; ++i) {
    const double c1 = k(i, 1), c3 = k(i, 3);
    const double w1 = (diagonal * c1 - off * c3) / determinant, w3 = (diagonal * c3 - off * c1) / determinant;
    EXPECT_NEAR(a.means()(i), promised(i) + w1 * (0.3 - 0.9) + w3 * (0.7 - 0.6), 1e-12);
    EXPECT_NEAR(std::pow(a.deviations()(i), 2), 2 - w1 * c1 - w3 * c3, 1e-12);
  }
}

TEST(Adaptation, StopsWhereTheBestObservedIsNearlyTheLargestPredicted) {
  Adaptation a(line(11), Vector::Constant(11, 1.0), {.length = 0.05});
  a.observe(0, 0.89);
  EXPECT_EQ(a.stopped(), "") << "elsewhere it is still 1";
  a.observe(5, 0.91);
  EXPECT_EQ(a.stopped(), "after trial 2 the best observed is 0.91 of the largest predicted");
  const Vector means = a.means();
  a.observe(7, 5);
  EXPECT_EQ(a.trials(), 2) << "no more is learned";
  EXPECT_EQ(a.means(), means);
}

// 0.9 of −1 is better than −1: within a tenth of the largest predicted means nothing there.
TEST(Adaptation, GoesOnWhereNothingAboveZeroIsPredicted) {
  for (const double promise : {-1.0, 0.0}) {
    Adaptation a(line(11), Vector::Constant(11, promise), {.length = 0.05, .max_trials = 3});
    a.observe(0, promise);
    a.observe(5, promise + 1e-4 * (promise < 0));
    EXPECT_EQ(a.stopped(), "");
    a.observe(7, promise);
    EXPECT_EQ(a.stopped(), "after trial 3: adaptation.max_trials");
  }
}

TEST(Adaptation, StopsAfterSoManyTrials) {
  Adaptation a(line(11), Vector::Constant(11, 1.0), {.length = 0.05, .max_trials = 3});
  for (Index trial = 0; trial < 3; ++trial) a.observe(2 * trial, 0.1);
  EXPECT_EQ(a.stopped(), "after trial 3: adaptation.max_trials");
}

TEST(Adaptation, SurvivesTheSameEliteAgainAndAgainAndPromisesOfNothing) {
  Adaptation a(Matrix::Constant(3, 20, 0.5), Vector::Zero(20), {.noise_variance = 1e-9, .max_trials = 500});
  for (int trial = 0; trial < 60; ++trial) a.observe(a.next(), -0.01 * trial);
  EXPECT_TRUE(a.means().allFinite() && a.deviations().allFinite());
}

/// A map of 6 descriptors in 5 bins whose performance is exp(−Σ (c_i − 0.7)²) of the cell's centre c; damage multiplies
/// it by 0.1 where c_1 > 0.5.
struct Map {
  Matrix centres{6, 15625};
  Vector promised{15625}, real{15625};
};

Map synthetic_map() {
  Map map;
  for (Index cell = 0; cell < 15625; ++cell) {
    Index rest = cell;
    for (Index d = 0; d < 6; ++d, rest /= 5) map.centres(d, cell) = 0.1 + 0.2 * static_cast<double>(rest % 5);
    map.promised(cell) = std::exp(-(map.centres.col(cell).array() - 0.7).square().sum());
    map.real(cell) = map.promised(cell) * (map.centres(0, cell) > 0.51 ? 0.1 : 1);
  }
  return map;
}

/// The map with as many cells as the original's had filled (13 200 of 15 625), drawn by the seed.
Map thinned(const Map& map, std::uint64_t seed) {
  Rng rng({.seed = seed, .purpose = Purpose::selection});
  std::vector<Index> kept;
  for (Index cell = 0; cell < 15625; ++cell)
    if (rng.uniform() < 13200.0 / 15625) kept.push_back(cell);
  return {map.centres(Eigen::all, kept), map.promised(kept), map.real(kept)};
}

struct Outcome {
  Index reached = 0;  // the first trial within 90 % of the best reachable; 0: none
  Index stopped = 0;  // the trial after which it stopped; 0: it did not
  double best = 0;    // of the policies that were tried, of the best reachable
};

/// Trials whose performance is measured with the noise that the GP assumes, σ² = 0.001.
Outcome adapt(const Map& map, double length, double stop_ratio, std::uint64_t seed) {
  Adaptation adaptation(map.centres, map.promised, {.length = length, .stop_ratio = stop_ratio, .max_trials = 15});
  Rng noise({.seed = seed, .purpose = Purpose::test});
  const double reachable = map.real.maxCoeff();
  Outcome outcome;
  for (Index trial = 1; trial <= 15 && adaptation.stopped().empty(); ++trial) {
    const Index cell = adaptation.next();
    outcome.best = std::max(outcome.best, map.real(cell) / reachable);
    if (outcome.reached == 0 && outcome.best >= 0.9) outcome.reached = trial;
    adaptation.observe(cell, map.real(cell) + std::sqrt(0.001) * noise.normal());
    if (!adaptation.stopped().empty()) outcome.stopped = trial;
  }
  return outcome;
}

/// The number of seeds 1 to 20 that come within 90 % of the best reachable without the stopping rule; prints the trials
/// (0: none), and the trial at which the rule stops with the best by then.
int reached(const char* name, double length, const std::function<Map(std::uint64_t seed)>& map_of) {
  int reached = 0;
  std::string trials, stops;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Map map = map_of(seed);
    const Outcome off = adapt(map, length, 0, seed), on = adapt(map, length, 0.9, seed);
    reached += off.reached > 0;
    trials += fmt::format(" {}", off.reached);
    stops += fmt::format(" {} ({:.2f})", on.stopped, on.best);
  }
  fmt::print("{}, ρ = {}: {} of 20, at trial{}\n  with the rule: stops after{}\n", name, length, reached, trials,
             stops);
  return reached;
}

// The requirement is 19 of 20. The ρ of the authors' code, 0.4, is two bins: what fails condemns its neighbours, among
// which the best that is left is. With half a bin it is found by going through them.
TEST(Adaptation, FindsWhatWorksOnADamagedRobot) {
  const Map map = synthetic_map();
  const auto whole = [&](std::uint64_t) { return map; };
  const auto thin = [&](std::uint64_t seed) { return thinned(map, seed); };
  EXPECT_GE(reached("all cells", 0.1, whole), 19);
  EXPECT_GE(reached("13 200 cells", 0.1, thin), 19);
  EXPECT_LE(reached("all cells", 0.4, whole), 1) << "docs/ite.md says otherwise";
}

}  // namespace
}  // namespace rehearse::learners::ite
