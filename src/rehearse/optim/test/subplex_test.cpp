#include <cmath>

#include <gtest/gtest.h>

#include "gradient_test_functions.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/optim/derivative_free.hpp"

namespace rehearse::optim {
namespace {

double quadratic(const Vector& x) {
  Vector gradient;
  return test::quadratic(x, gradient);
}

const SubplexOptions accurate{.max_evaluations = 5000, .x_tolerance = 1e-8, .value_tolerance = 1e-10};

TEST(Subplex, FindsTheMaximumInsideAndOnTheBound) {
  const ScalarResult inside = maximise_subplex(quadratic, Vector::Zero(4), std::vector<Interval>(4, {-5, 5}), accurate);
  EXPECT_LT((inside.x - Vector::Ones(4)).norm(), 1e-3) << inside.stop;
  const ScalarResult bound = maximise_subplex(quadratic, Vector{{0, -2}}, {{0, 0.5}, {-2, 3}}, accurate);
  EXPECT_LT((bound.x - Vector{{0.5, 1}}).norm(), 1e-3) << bound.stop;
}

TEST(Subplex, StaysInItsBoxAndCounts) {
  Index calls = 0;
  const auto f = [&](const Vector& x) {
    ++calls;
    EXPECT_TRUE((x.array() >= 0.05).all() && (x.array() <= 1.2).all());
    return std::sin(20 * x(0)) + x(1);
  };
  const auto result = maximise_subplex(f, Vector{{0.5, 0.5}}, {{0.05, 1.2}, {0.05, 1.2}}, {.max_evaluations = 37});
  EXPECT_EQ(result.evaluations, calls);
  EXPECT_LE(calls, 37);
}

TEST(Subplex, ToleratesPointsWithoutValue) {
  const auto f = [](const Vector& x) { return x(0) + x(1) > 1.5 ? std::nan("") : quadratic(x); };
  const auto result = maximise_subplex(f, Vector{{0.0, 0.0}}, {{-3, 3}, {-3, 3}}, accurate);
  EXPECT_LE(result.x.sum(), 1.5);
  EXPECT_GT(result.value, 2.5);
  const auto none = maximise_subplex([](const Vector&) { return std::nan(""); }, Vector{{1}}, {{0, 2}}, {});
  EXPECT_EQ(none.stop, "no finite value");
  EXPECT_EQ(none.x(0), 1);
}

TEST(Subplex, ReportsEveryViolation) {
  try {
    maximise_subplex(quadratic, Vector{{4}}, {{2, 1}, {0, 1}}, {.max_evaluations = 0});
    FAIL();
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    for (const char* part : {"subplex.max_evaluations = 0", "box has 2", "box[0]", "start[0] = 4"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

TEST(Combinations, VaryTheLastFastest) {
  const auto all = combinations({{1, 2}, {5, 6, 7}});
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[0], (Vector{{1, 5}}));
  EXPECT_EQ(all[1], (Vector{{1, 6}}));
  EXPECT_EQ(all[5], (Vector{{2, 7}}));
  EXPECT_EQ(combinations({}).size(), 1u);
  EXPECT_TRUE(combinations({{1}, {}}).empty());
}

}  // namespace
}  // namespace rehearse::optim
