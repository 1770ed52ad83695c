#include "rehearse/optim/cautious_bfgs.hpp"

#include <gtest/gtest.h>

#include "gradient_test_functions.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::optim {
namespace {

TEST(CautiousBfgs, FindsMaxima) {
  const GradientResult quadratic = maximise_cautious_bfgs(test::quadratic, Vector::Constant(5, -3), {});
  EXPECT_NEAR(quadratic.value, 3, 1e-12);
  const GradientResult rosenbrock = maximise_cautious_bfgs(test::rosenbrock, Vector{{-1, 1}}, {});
  EXPECT_LT((rosenbrock.x - Vector::Ones(2)).norm(), 1e-6);
  EXPECT_EQ(rosenbrock.stop, "converged");
}

TEST(CautiousBfgs, FindsTheMaximumOfManyCoordinates) {
  const Index n = 1400;
  const Differentiable bowl = [n](const Vector& x, Vector& gradient) {
    const Vector scale = Vector::LinSpaced(n, 1, 100);
    gradient = -scale.cwiseProduct(x);
    return x.dot(gradient) / 2;
  };
  EXPECT_GT(maximise_cautious_bfgs(bowl, Vector::Ones(n), {}).value, -1e-10);
}

TEST(CautiousBfgs, ComesBackFromPointsWithoutValue) {
  const GradientResult result = maximise_cautious_bfgs(test::log_barrier, Vector::Constant(1, 20), {});
  EXPECT_NEAR(result.x(0), 1, 1e-6);
}

/// Two hills, the other one far and lower: the gradient is large, and a step in proportion would leave.
TEST(CautiousBfgs, StaysOnItsHill) {
  const Differentiable hills = [](const Vector& x, Vector& gradient) {
    const double d = x(0) - 60, near = 1000 * std::exp(-x(0) * x(0)), far = 500 * std::exp(-d * d / 100);
    gradient = Vector{{-2 * x(0) * near - d / 50 * far}};
    return near + far;
  };
  EXPECT_NEAR(maximise_cautious_bfgs(hills, Vector::Constant(1, -1), {}).value, 1000, 1e-6);
}

TEST(CautiousBfgs, KeepsItsLimits) {
  const CautiousBfgsOptions options{.line_searches = 3, .line_evaluations = 2};
  const GradientResult result = maximise_cautious_bfgs(test::rosenbrock, Vector{{-1, 1}}, options);
  Vector gradient;
  EXPECT_LE(result.evaluations, 1 + 3 * 2);
  EXPECT_EQ(result.value, test::rosenbrock(result.x, gradient));
  EXPECT_GE(result.value, -4) << "no worse than the start";
}

TEST(CautiousBfgs, StopsWhereItGainsLittle) {
  const Differentiable valley = [](const Vector& x, Vector& gradient) { return 10 + test::rosenbrock(x, gradient); };
  const auto run = [&](Index patience, double gain) {
    return maximise_cautious_bfgs(valley, Vector{{-1, 1}}, {.patience = patience, .patience_gain = gain});
  };
  const GradientResult whole = run(0, 1), impatient = run(3, 0.1), patient = run(3, 1e-6);
  EXPECT_EQ(whole.stop, "converged");
  EXPECT_EQ(impatient.stop, "patience");
  EXPECT_LT(impatient.value, whole.value);
  EXPECT_LT(impatient.evaluations, patient.evaluations);
  EXPECT_LE(patient.evaluations, whole.evaluations);
}

TEST(CautiousBfgs, StopsWhenTheStartHasNoValue) {
  const GradientResult result = maximise_cautious_bfgs(test::log_barrier, Vector::Constant(1, -1), {});
  EXPECT_EQ(result.stop, "no finite value");
  EXPECT_EQ(result.evaluations, 1);
  EXPECT_EQ(result.x(0), -1);
}

TEST(CautiousBfgs, ReportsEveryViolation) {
  try {
    maximise_cautious_bfgs(test::quadratic, Vector(0), {.line_searches = 0, .longest_step = 0});
    FAIL();
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    for (const char* part : {"cautious_bfgs.line_searches = 0", "cautious_bfgs.longest_step = 0", "start"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace rehearse::optim
