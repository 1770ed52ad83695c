#include "rehearse/policy/squash_slope.hpp"

#include <gtest/gtest.h>

namespace rehearse::policy {
namespace {

TEST(SquashSlope, IsThatOfTheSquash) {
  for (const auto shape : {Squash::Shape::tanh, Squash::Shape::sine}) {
    const Squash squash{{{-2, 4}, {-1, 1}}, 3, shape};
    const Matrix a{{0.1, -0.2}, {0, 0}, {0.5, -5}};
    Matrix slope = a, more = a.array() + 1e-6, less = a.array() - 1e-6;
    squash_slope(squash, slope);
    squash.apply(more);
    squash.apply(less);
    EXPECT_LT((slope - (more - less) / 2e-6).cwiseAbs().maxCoeff(), 1e-8);
  }
}

}  // namespace
}  // namespace rehearse::policy
