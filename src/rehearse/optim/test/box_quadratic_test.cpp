#include "rehearse/optim/box_quadratic.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse::optim {
namespace {

TEST(BoxQuadratic, IsNewtonsStepInside) {
  const Matrix H{{2, 0.5}, {0.5, 1}};
  const Vector g{{-1, 0.3}}, wide = Vector::Constant(2, 10);
  const auto minimum = minimise_in_box(H, g, -wide, wide, Vector::Zero(2));
  ASSERT_TRUE(minimum);
  EXPECT_TRUE((H * minimum->x).isApprox(-g, 1e-10));
  EXPECT_TRUE(minimum->free.all());
}

/// Karush's, Kuhn's and Tucker's conditions, on random problems.
TEST(BoxQuadratic, NothingInTheBoxIsLower) {
  Rng rng({.seed = 3});
  for (int problem = 0; problem < 200; ++problem) {
    const Index n = 1 + problem % 5;
    Matrix root(n, n);
    for (double& v : root.reshaped()) v = rng.normal();
    const Matrix H = root * root.transpose() + 0.05 * Matrix::Identity(n, n);
    Vector g(n), low(n), high(n);
    for (Index i = 0; i < n; ++i) g(i) = 3 * rng.normal(), low(i) = -rng.uniform(), high(i) = rng.uniform();
    const auto minimum = minimise_in_box(H, g, low, high, Vector::Zero(n));
    ASSERT_TRUE(minimum);
    const Vector gradient = H * minimum->x + g;
    for (Index i = 0; i < n; ++i) {
      const double x = minimum->x(i);
      EXPECT_TRUE(low(i) <= x && x <= high(i));
      if (minimum->free(i)) {
        EXPECT_NEAR(gradient(i), 0, 1e-8) << problem;
      } else {
        EXPECT_TRUE(x == low(i) ? gradient(i) > 0 : gradient(i) < 0) << problem;
      }
    }
  }
}

TEST(BoxQuadratic, SaysWhereThereIsNoMinimum) {
  const Vector one = Vector::Ones(2);
  EXPECT_FALSE(minimise_in_box(Matrix{{1, 0}, {0, -1}}, one, -one, one, Vector::Zero(2)));
  EXPECT_FALSE(minimise_in_box(Matrix::Identity(2, 2), Vector{{kNaN, 0}}, -one, one, Vector::Zero(2)));
}

TEST(BoxQuadratic, OfAHessianThatIsNotFiniteThereIsNone) {
  const Vector one = Vector::Ones(2);
  EXPECT_FALSE(minimise_in_box(Matrix{{kNaN, 0}, {0, 1}}, one, -one, one, Vector::Zero(2)));
}

}  // namespace
}  // namespace rehearse::optim
