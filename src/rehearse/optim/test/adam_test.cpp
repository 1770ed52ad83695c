#include "rehearse/optim/adam.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse::optim {
namespace {

TEST(Adam, ItsFirstStepsAreThoseOfTheAlgorithm) {
  const AdamOptions options{.step = 0.1, .last_step = 0.1};
  Adam adam(2, options);
  Vector x = Vector::Zero(2);
  adam.ascend(x, Vector{{4, -0.01}}, 0);
  EXPECT_LT((x - Vector{{0.1, -0.1}}).norm(), 1e-6) << "a step is as long whatever the gradient's scale";
  const Vector before = x;
  adam.ascend(x, Vector{{-2, -0.01}}, 0.5);
  const double mean = (0.9 * 0.4 - 0.1 * 2) / (1 - 0.81), square = (0.999 * 0.016 + 0.001 * 4) / (1 - 0.999 * 0.999);
  EXPECT_NEAR(x(0) - before(0), 0.1 * mean / std::sqrt(square), 1e-9);
  EXPECT_NEAR(x(1) - before(1), -0.1, 1e-6);
}

TEST(Adam, TheStepFallsGeometrically) {
  for (const double done : {0.0, 0.5, 1.0}) {
    Adam adam(1, {.step = 0.16, .last_step = 0.01});
    Vector x = Vector::Zero(1);
    adam.ascend(x, Vector{{3}}, done);
    EXPECT_NEAR(x(0), 0.16 * std::pow(1.0 / 16, done), 1e-8);
  }
}

TEST(Adam, FindsTheMaximumOfANoisyFunctionOfManyScales) {
  const Vector curvature{{1, 100, 0.01}}, maximum{{1, -2, 0.5}};
  Adam adam(3, {.step = 0.05, .last_step = 0.001});
  Vector x = Vector::Zero(3);
  Rng rng({.seed = 1});
  for (Index i = 0; i < 4000; ++i) {
    Vector gradient = curvature.cwiseProduct(maximum - x);
    for (Index d = 0; d < 3; ++d) gradient(d) += curvature(d) * rng.normal();
    adam.ascend(x, gradient, static_cast<double>(i) / 4000);
  }
  EXPECT_LT((x - maximum).norm(), 0.1) << x.transpose();
}

TEST(Adam, PassesOverAGradientThatIsNotFinite) {
  Adam adam(2, {}), other(2, {});
  Vector x = Vector::Ones(2), y = x;
  adam.ascend(x, Vector{{1, kNaN}}, 0);
  EXPECT_EQ(x, y);
  adam.ascend(x, Vector{{1, 2}}, 0);
  other.ascend(y, Vector{{1, 2}}, 0);
  EXPECT_EQ(x, y);
}

}  // namespace
}  // namespace rehearse::optim
