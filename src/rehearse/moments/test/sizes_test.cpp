// Wrong sizes are refused by everything that takes a Gaussian or inducing inputs.

#include <gtest/gtest.h>

#include "rehearse/gp/test/sizes_fixture.hpp"
#include "rehearse/moments/fitc.hpp"
#include "rehearse/moments/moment_matching.hpp"

namespace rehearse::moments {
namespace {

using gp::complaint, gp::contains;
using Sizes = gp::SizesFixture;

TEST_F(Sizes, OfInducingInputs) {
  const Vector y = Y.col(0);
  EXPECT_TRUE(contains(complaint([&] { fitc_evidence(X, y.head(9), X, theta); }), "9 targets for 12 inputs"));
  EXPECT_TRUE(contains(complaint([&] { fitc_evidence(X, y, X.leftCols(2), theta); }), "must be m × 3"));
}

TEST_F(Sizes, OfMoments) {
  const MomentMatching matching(exact_terms(posterior), 2);
  MomentTape tape;
  Transformed result, adjoint;
  Gaussian x{Vector::Zero(3), 0.1 * Matrix::Identity(3, 3)}, input = Gaussian::zero(3);
  const auto forward = [&](const Gaussian& at) { return complaint([&] { matching.forward(at, tape, result); }); };
  EXPECT_TRUE(contains(forward({Vector::Zero(2), Matrix::Zero(3, 3)}), "= 2, must be 3"));
  EXPECT_TRUE(contains(forward({Vector::Zero(3), Matrix::Zero(3, 2)}), "3 × 2, must be 3 × 3"));
  EXPECT_EQ(forward(x), "none");
  adjoint = result;
  const auto backward = [&] { return complaint([&] { matching.adjoint(x, tape, result, adjoint, input); }); };
  EXPECT_EQ(backward(), "none");
  adjoint.gain.resize(2, 3);
  EXPECT_TRUE(contains(backward(), "2 × 3, must be 3 × 2"));
  adjoint = result, input = Gaussian::zero(2);
  EXPECT_TRUE(contains(backward(), "= 2, must be 3"));
  EXPECT_TRUE(contains(complaint([&] { evaluate_means(exact_terms(posterior), 2, X.leftCols(2)); }), "= 2, must be 3"));
  EXPECT_TRUE(contains(complaint([&] { evaluate_means(exact_terms(posterior), 1, X); }), "must be below 1"));
}

}  // namespace
}  // namespace rehearse::moments
