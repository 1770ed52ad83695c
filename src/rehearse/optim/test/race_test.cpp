#include "rehearse/optim/race.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::optim {
namespace {

const std::vector<Interval> kBox(3, Interval{-2, 2});

/// −‖x − 1‖².
void spheres(const ConstMatrixView& X, std::uint64_t, Index, VectorView values) {
  values = -(X.array() - 1).square().colwise().sum().transpose();
}

RaceResult run(const RaceOptions& options, const SearchSpace& space = {.box = kBox}) {
  return race(spheres, space, options, {.purpose = Purpose::search}, serial_evaluator());
}

TEST(Race, FindsTheOptimumAndPutsTheBestFirst) {
  const RaceResult result = run({.max_evaluations = 5000, .descents = 8});
  EXPECT_NEAR(result.contenders.front().value, 0, 1e-3);
  for (std::size_t i = 1; i < result.contenders.size(); ++i)
    EXPECT_GE(result.contenders[i - 1].value, result.contenders[i].value);
  EXPECT_EQ(result.contenders.size(), 8u);
}

TEST(Race, NeverExceedsItsEvaluations) {
  for (Index most : {16, 17, 18, 21, 40, 100, 300, 1000, 3000})
    for (Index rounds : {1, 2, 5, 100}) {
      Index counted = 0;
      const BatchObjective objective = [&](const ConstMatrixView& X, std::uint64_t first, Index samples,
                                           VectorView values) {
        counted += X.cols() * samples;
        spheres(X, first, samples, values);
      };
      const RaceResult result =
          race(objective, {.box = kBox},
               {.max_evaluations = most, .descents = 8, .rounds = rounds, .judgements = most < 30 ? 1 : 16},
               {.purpose = Purpose::search}, serial_evaluator());
      EXPECT_EQ(result.evaluations, counted);
      EXPECT_LE(counted, most) << rounds << " rounds";
      EXPECT_EQ(result.contenders.size(), 8u);
    }
}

TEST(Race, SaysWhatItNeedsAtLeast) {
  try {
    run({.max_evaluations = 15, .descents = 8});
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "race.max_evaluations = 15, must be ≥ 2 × descents = 16");
  }
}

TEST(Race, BeginsAtTheStarts) {
  const Vector good = Vector::Ones(3);
  const SearchSpace space{.box = kBox, .starts = std::vector<Vector>(1, good)};
  EXPECT_GE(run({.max_evaluations = 300, .descents = 2, .start_sigma = 1e-3}, space).contenders.front().value, -1e-4);
}

/// The farthest point of the first generation from the middle of the box, for every second descent.
Vector reach_of_first_generations(const RaceOptions& options) {
  Vector reach = Vector::Zero(2);
  const BatchObjective objective = [&](const ConstMatrixView& X, std::uint64_t first, Index, VectorView values) {
    spheres(X, first, 1, values);
    for (Index i = 0; first == 0 && i < X.cols(); ++i) {
      double& farthest = reach(i / options.cmaes.population % 2);
      farthest = std::max(farthest, (X.col(i).array() - 3).abs().maxCoeff());
    }
  };
  const std::vector<Interval> box(3, Interval{1, 5});
  race(objective, {.box = box}, options, {.purpose = Purpose::search}, serial_evaluator());
  return reach;
}

TEST(Race, EverySecondDescentBeginsNearTheCentreOfTheBoxWithSmallSteps) {
  const RaceOptions options{.max_evaluations = 5000, .descents = 8, .sigma = 0.1, .near_centre = 0.2};
  const Vector reach = reach_of_first_generations(options);
  EXPECT_GT(reach(0), 1.5);
  EXPECT_LT(reach(1), 0.4 + 5 * 0.02);  // the start and five steps
  RaceOptions without = options;
  without.near_centre = 1;
  EXPECT_GT(reach_of_first_generations(without)(1), 1.5);
}

TEST(Race, ANarrowOptimumNearTheCentreIsFoundFromThere) {
  // Away from the centre the function says nothing, as returns do where a network's actions jump from bound to bound.
  const std::vector<Interval> box(10, Interval{-5, 5});
  const BatchObjective narrow = [](const ConstMatrixView& X, std::uint64_t, Index, VectorView values) {
    values = (1 - (X.array() - 0.3).square().colwise().sum() / 10).max(0).transpose();
  };
  const auto best = [&](double near_centre) {
    return race(narrow, {.box = box}, {.max_evaluations = 5000, .descents = 8, .near_centre = near_centre},
                {.purpose = Purpose::search}, serial_evaluator())
        .contenders.front()
        .value;
  };
  EXPECT_GT(best(0.2), 0.99);
  EXPECT_LT(best(1), 0.5);
}

}  // namespace
}  // namespace rehearse::optim
