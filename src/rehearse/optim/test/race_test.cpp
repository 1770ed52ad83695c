#include "rehearse/optim/race.hpp"

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

}  // namespace
}  // namespace rehearse::optim
