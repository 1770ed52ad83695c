#include "rehearse/testing/check_gradient.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/gp/evidence.hpp"

namespace rehearse::testing {
namespace {

double rosenbrock(const Vector& x, Vector& gradient) {
  const double a = 1 - x(0), b = x(1) - x(0) * x(0);
  gradient = Vector{{-2 * a - 400 * x(0) * b, 200 * b}};
  return a * a + 100 * b * b;
}

TEST(CheckGradient, AcceptsARightOne) {
  for (const Vector& x : {Vector{{-1.2, 1}}, Vector{{1, 1}}, Vector{{3, -40}}})
    EXPECT_EQ(check_gradient(rosenbrock, x), std::vector<std::string>{});
}

TEST(CheckGradient, AcceptsThatOfTheEvidence) {
  const gp::Inputs inputs(Matrix::Random(20, 2));
  const Vector y = Vector::Random(20);
  gp::Workspace workspace;
  const auto evidence = [&](const Vector& flat, Vector& gradient) {
    return gp::evidence(inputs, y, flat, workspace, &gradient).value;
  };
  EXPECT_EQ(check_gradient(evidence, Vector{{-0.5, 0.1, 0.2, -1}}, 1e-6), std::vector<std::string>{});
}

TEST(CheckGradient, NamesTheComponentThatIsWrong) {
  const auto wrong = [](const Vector& x, Vector& gradient) {
    const double value = rosenbrock(x, gradient);
    gradient(1) *= 1.001;
    return value;
  };
  const auto lines = check_gradient(wrong, Vector{{-1.2, 1}});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].find("gradient[1]"), 0u);
}

TEST(CheckGradient, FindsNanAndMemory) {
  const auto nan = [](const Vector& x, Vector& gradient) {
    return rosenbrock(x, gradient) + std::sqrt(-1 - x(0) * x(0));
  };
  EXPECT_FALSE(check_gradient(nan, Vector{{0, 0}}).empty());
  int calls = 0;
  const auto counting = [&](const Vector& x, Vector& gradient) { return rosenbrock(x, gradient) + 1e-9 * ++calls; };
  EXPECT_NE(check_gradient(counting, Vector{{0, 0}}, 1e-3).size(), 0u);
}

}  // namespace
}  // namespace rehearse::testing
