#include "rehearse/gp/sizes.hpp"

#include <gtest/gtest.h>

#include "rehearse/gp/evidence.hpp"
#include "sizes_fixture.hpp"

namespace rehearse::gp {
namespace {

using Sizes = SizesFixture;

TEST_F(Sizes, SayNameValueAndBound) {
  EXPECT_EQ(complaint([] { require_size("rows", 3, 4); }), "gp rows = 3, must be 4");
  EXPECT_EQ(complaint([] { require_shape("mean", 3, 2, 3, 1); }), "gp mean is 3 × 2, must be 3 × 1");
  EXPECT_EQ(complaint([] { require_size("rows", 4, 4), require_shape("mean", 3, 2, 3, 2); }), "none");
}

TEST_F(Sizes, OfPredictions) {
  Matrix mean(12, 2), variance(12, 2), few(11, 2), narrow(12, 1);
  EXPECT_TRUE(contains(complaint([&] { posterior.predict(X.leftCols(2), mean, variance); }), "12 × 2, must be 12 × 3"));
  EXPECT_TRUE(contains(complaint([&] { posterior.predict(X, few, variance); }), "11 × 2, must be 12 × 2"));
  EXPECT_TRUE(contains(complaint([&] { posterior.predict(X, mean, narrow); }), "12 × 1, must be 12 × 2"));
  EXPECT_TRUE(contains(complaint([&] { posterior.predict_mean(X.leftCols(2), mean); }), "must be 12 × 3"));
  EXPECT_TRUE(contains(complaint([&] { posterior.predict_mean(X, narrow); }), "must be 12 × 2"));
}

TEST_F(Sizes, OfEvidence) {
  Workspace workspace;
  const Vector y = Y.col(0), flat = theta.flat();
  const KnownNoise of_nine(Matrix::Identity(9, 9));
  EXPECT_TRUE(contains(complaint([&] { evidence(inputs, y.head(9), flat, workspace); }), "= 9, must be 12"));
  EXPECT_TRUE(contains(complaint([&] { evidence(inputs, y, flat.head(4), workspace); }), "= 4, must be 5"));
  EXPECT_TRUE(contains(complaint([&] { evidence(inputs, y, flat, workspace, nullptr, &of_nine); }), "= 9, must be 12"));
  EXPECT_TRUE(contains(complaint([&] { KnownNoise(Matrix::Identity(9, 8)); }), "9 × 8, must be 9 × 9"));
  EXPECT_TRUE(contains(complaint([&] { penalty(inputs, flat.head(4), {}); }), "= 4, must be 5"));
  const Whitening whitening(inputs, theta);
  EXPECT_TRUE(contains(complaint([&] { whitening(Y.topRows(9)); }), "= 9, must be 12"));
  EXPECT_TRUE(contains(complaint([&] { (void)whitening.log_evidence(y.head(9)); }), "= 9, must be 12"));
  EXPECT_TRUE(contains(complaint([&] { Whitening(inputs, naive::hyperparameters(2, 1, 1, 0.1)); }), "= 4, must be 5"));
}

}  // namespace
}  // namespace rehearse::gp
