#include <gtest/gtest.h>

#include "gradient_test_functions.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/optim/gradient.hpp"

namespace rehearse::optim {
namespace {

TEST(Bfgs, FindsTheMaximum) {
  const GradientResult quadratic = maximise_bfgs(test::quadratic, Vector::Constant(30, -3), {});
  EXPECT_LT((quadratic.x - Vector::Ones(30)).norm(), 1e-3);
  const GradientResult result = maximise_bfgs(test::rosenbrock, Vector{{-1.2, 1}}, {.relative_tolerance = 1e-12});
  EXPECT_LT((result.x - Vector::Ones(2)).norm(), 1e-4);
  EXPECT_EQ(result.stop, "converged");
}

TEST(Bfgs, LearnsTheCurvatureAndProfitsFromIt) {
  Matrix inverse_hessian;
  const BfgsOptions exact{.relative_tolerance = 1e-14};
  const GradientResult first = maximise_bfgs(test::quadratic, Vector::Constant(8, -3), exact, &inverse_hessian);
  Vector expected(8);  // the Hessian is −2 (i + 1) on its diagonal
  for (Index i = 0; i < 8; ++i) expected(i) = 1 / (2.0 * static_cast<double>(i + 1));
  EXPECT_LT((inverse_hessian.diagonal() - expected).cwiseAbs().maxCoeff(), 0.1);
  const GradientResult again = maximise_bfgs(test::quadratic, Vector::Constant(8, 5), exact, &inverse_hessian);
  EXPECT_LT((again.x - Vector::Ones(8)).norm(), 1e-3);
  EXPECT_LE(2 * again.evaluations, first.evaluations) << again.evaluations << " " << first.evaluations;
}

TEST(Bfgs, WrongCurvatureIsNoHarm) {
  for (Matrix wrong :
       {Matrix(-Matrix::Identity(2, 2)), Matrix(1e8 * Matrix::Identity(2, 2)), Matrix(1e-8 * Matrix::Identity(2, 2)),
        Matrix(Matrix::Identity(3, 3)), Matrix(Matrix::Constant(2, 2, kNaN))}) {
    const GradientResult result =
        maximise_bfgs(test::rosenbrock, Vector{{-1.2, 1}}, {.relative_tolerance = 1e-12}, &wrong);
    EXPECT_LT((result.x - Vector::Ones(2)).norm(), 1e-4) << wrong;
  }
}

TEST(Bfgs, ComesBackFromPointsWithoutValue) {
  for (const double start : {0.01, 0.5, 5.0, 50.0})
    EXPECT_NEAR(maximise_bfgs(test::log_barrier, Vector::Constant(1, start), {}).value, -1, 1e-6) << start;
}

TEST(Bfgs, StopsWhenTheStartHasNoValue) {
  const GradientResult result = maximise_bfgs(test::log_barrier, Vector::Constant(1, -1), {});
  EXPECT_EQ(result.stop, "no finite value");
  EXPECT_FALSE(std::isfinite(result.value));
}

TEST(Bfgs, CountsEvaluationsAndPassesExceptionsOn) {
  Index calls = 0;
  const auto counted = [&](const Vector& x, Vector& gradient) { return ++calls, test::rosenbrock(x, gradient); };
  const GradientResult cut = maximise_bfgs(counted, Vector{{-1.2, 1}}, {.max_evaluations = 5});
  EXPECT_EQ(cut.stop, "max_evaluations");
  EXPECT_EQ(cut.evaluations, calls);
  EXPECT_EQ(calls, 5);
  const auto thrower = [](const Vector&, Vector&) -> double { throw std::runtime_error("stop here"); };
  EXPECT_THROW(maximise_bfgs(thrower, Vector::Ones(2), {}), std::runtime_error);
}

TEST(Bfgs, ReportsEveryViolation) {
  try {
    maximise_bfgs(test::quadratic, Vector(0), {.max_evaluations = 0});
    FAIL();
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    for (const char* part : {"bfgs.max_evaluations = 0", "start has no coordinates"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace rehearse::optim
