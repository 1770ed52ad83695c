#include <gtest/gtest.h>

#include "gradient_test_functions.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/optim/gradient.hpp"

namespace rehearse::optim {
namespace {

TEST(Rprop, FindsTheMaximumOfAQuadratic) {
  const GradientResult result = maximise_rprop(test::quadratic, Vector::Constant(5, -3), {});
  EXPECT_EQ(result.stop, "converged");
  EXPECT_NEAR(result.value, 3, 1e-8);
  EXPECT_LT((result.x - Vector::Ones(5)).norm(), 1e-4);
}

TEST(Rprop, ComesBackFromPointsWithoutValue) {
  const GradientResult result = maximise_rprop(test::log_barrier, Vector::Constant(1, 20), {.first_step = 15});
  EXPECT_NEAR(result.x(0), 1, 1e-3);
  EXPECT_EQ(result.stop, "converged");
}

TEST(Rprop, StopsWhenTheStartHasNoValue) {
  const GradientResult result = maximise_rprop(test::log_barrier, Vector::Constant(1, -1), {});
  EXPECT_EQ(result.stop, "no finite value");
  EXPECT_EQ(result.evaluations, 1);
  EXPECT_EQ(result.x(0), -1);
}

TEST(Rprop, KeepsTheBestPointOfAnInterruptedSearch) {
  const GradientResult result = maximise_rprop(test::rosenbrock, Vector{{-1, 1}}, {.max_evaluations = 7});
  Vector gradient;
  EXPECT_EQ(result.stop, "max_evaluations");
  EXPECT_EQ(result.evaluations, 7);
  EXPECT_EQ(result.value, test::rosenbrock(result.x, gradient));
  EXPECT_GE(result.value, -4);
}

TEST(Rprop, ReportsEveryViolation) {
  try {
    maximise_rprop(test::quadratic, Vector(0), {.max_evaluations = 0, .first_step = 100});
    FAIL();
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    for (const char* part : {"rprop.max_evaluations = 0", "rprop.first_step = 100", "start"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace rehearse::optim
