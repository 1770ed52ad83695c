#include <limits>

#include <gtest/gtest.h>

#include "gradient_test_functions.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/optim/gradient.hpp"

namespace rehearse::optim {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

GradientResult unbounded(const Differentiable& f, const Vector& start, const LbfgsOptions& options = {}) {
  const Index n = start.size();
  return maximise_lbfgs(f, start, Vector::Constant(n, -infinity), Vector::Constant(n, infinity), options);
}

TEST(Lbfgs, FindsTheMaximum) {
  EXPECT_LT((unbounded(test::quadratic, Vector::Constant(30, -3)).x - Vector::Ones(30)).norm(), 1e-3);
  const GradientResult result = unbounded(test::rosenbrock, Vector{{-1.2, 1}}, {.relative_tolerance = 1e-12});
  EXPECT_LT((result.x - Vector::Ones(2)).norm(), 1e-4);
  EXPECT_EQ(result.stop, "converged");
}

TEST(Lbfgs, StaysInItsBox) {
  const Vector low{{-2, -2}}, high{{0.5, 3}};
  const auto f = [&](const Vector& x, Vector& gradient) {
    EXPECT_TRUE((x.array() >= low.array()).all() && (x.array() <= high.array()).all());
    return test::quadratic(x, gradient);
  };
  const Vector x = maximise_lbfgs(f, Vector{{-1, -1}}, low, high, {}).x;
  EXPECT_LT((x - Vector{{0.5, 1}}).norm(), 1e-4);
}

TEST(Lbfgs, ComesBackFromPointsWithoutValue) {
  for (const double start : {0.01, 0.5, 5.0, 50.0})
    EXPECT_NEAR(unbounded(test::log_barrier, Vector::Constant(1, start)).value, -1, 1e-6) << start;
}

TEST(Lbfgs, StopsWhenTheStartHasNoValue) {
  const GradientResult result = unbounded(test::log_barrier, Vector::Constant(1, -1));
  EXPECT_EQ(result.stop, "no finite value");
  EXPECT_FALSE(std::isfinite(result.value));
}

TEST(Lbfgs, CountsEvaluationsAndPassesExceptionsOn) {
  EXPECT_EQ(unbounded(test::rosenbrock, Vector{{-1.2, 1}}, {.max_evaluations = 5}).stop, "max_evaluations");
  const auto thrower = [](const Vector&, Vector&) -> double { throw std::runtime_error("stop here"); };
  EXPECT_THROW(unbounded(thrower, Vector::Ones(2)), std::runtime_error);
}

TEST(Lbfgs, ReportsEveryViolation) {
  try {
    maximise_lbfgs(test::quadratic, Vector{{4, -4}}, Vector{{0, 0}}, Vector{{1, 1}}, {.max_evaluations = 0});
    FAIL();
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    for (const char* part : {"lbfgs.max_evaluations = 0", "start[0] = 4", "start[1] = -4"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace rehearse::optim
