#include "rehearse/moments/fitc.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/gp/test/naive.hpp"
#include "rehearse/moments/moment_matching.hpp"
#include "rehearse/moments/test/gaussian_tools.hpp"

namespace rehearse::moments {
namespace {

struct Data {
  Matrix X = gp::naive::normals(25, 3, 1);
  gp::Hyperparameters theta = gp::naive::hyperparameters(3, 1, 1.3, 0.3);
  Vector y = gp::naive::draw(X, theta, 2);
  Matrix Z = gp::naive::normals(7, 3, 3);
};

TEST(Fitc, EvidenceIsThatOfItsCovariance) {
  const Data d;
  Matrix Kmm = gp::naive::covariance(d.Z, d.Z, d.theta);
  Kmm.diagonal().array() += 1e-6 * d.theta.signal_variance();
  const Matrix Kmn = gp::naive::covariance(d.Z, d.X, d.theta), Q = Kmn.transpose() * Kmm.llt().solve(Kmn);
  Matrix covariance = Q;
  covariance.diagonal().setConstant(d.theta.signal_variance() + d.theta.noise_variance());
  const Eigen::LLT<Matrix> llt(covariance);
  const double expected =
      -0.5 * d.y.dot(llt.solve(d.y)) - llt.matrixLLT().diagonal().array().log().sum() - 12.5 * std::log(2 * M_PI);
  EXPECT_NEAR(fitc_evidence(d.X, d.y, d.Z, d.theta), expected, 1e-9 * std::abs(expected));
  EXPECT_NEAR(fitc_evidence(d.X, d.y, d.X, d.theta, nullptr, 1e-10), gp::naive::evidence(d.X, d.y, d.theta), 1e-6);
}

TEST(Fitc, UnitsOfTheTargetsDoNotMatter) {
  const Data d;
  const double mm = 1e-3;  // targets in thousandths of their unit
  const gp::Hyperparameters small = gp::naive::hyperparameters(3, 1, 1.3 * mm, 0.3 * mm);
  ASSERT_NEAR(small.signal_variance(), mm * mm * d.theta.signal_variance(), 1e-12);
  const double expected = fitc_evidence(d.X, d.y, d.Z, d.theta) - 25 * std::log(mm);
  EXPECT_NEAR(fitc_evidence(d.X, mm * d.y, d.Z, small), expected, 1e-9 * std::abs(expected));
}

TEST(Fitc, GradientAgreesWithDifferences) {
  const Data d;
  Matrix gradient;
  fitc_evidence(d.X, d.y, d.Z, d.theta, &gradient);
  const Vector expected = tools::slopes(
      [&](const Vector& z) { return fitc_evidence(d.X, d.y, z.reshaped(7, 3).eval(), d.theta); }, d.Z.reshaped(), 1e-3);
  EXPECT_LT((gradient.reshaped() - expected).norm(), 1e-8 * expected.norm());
}

TEST(Fitc, WhatCannotBeComputedIsNan) {
  Data d;
  Matrix gradient;
  d.Z(2, 1) = std::nan("");
  EXPECT_TRUE(std::isnan(fitc_evidence(d.X, d.y, d.Z, d.theta, &gradient)));
  EXPECT_TRUE(gradient.array().isNaN().all());
  d.Z.row(2) = d.Z.row(1);  // singular but for the ridge
  EXPECT_TRUE(std::isfinite(fitc_evidence(d.X, d.y, d.Z, d.theta, &gradient)));
  EXPECT_TRUE(gradient.allFinite());
}

TEST(Fitc, RefusesSizesThatDoNotAgree) {
  const Data d;
  EXPECT_THROW(fitc_terms(d.X, d.y, d.Z.leftCols(2), {d.theta}), InvalidInput);
  EXPECT_THROW(fitc_terms(d.X, d.y, d.Z, {d.theta, d.theta}), InvalidInput);
  EXPECT_THROW(fitc_terms(d.X, d.y.head(3), d.Z, {d.theta}), InvalidInput);
  gp::Hyperparameters trend = d.theta;
  trend.log_trend = Vector::Zero(d.X.cols() + 1);
  EXPECT_THROW(fitc_terms(d.X, d.y, d.Z, {trend}), InvalidInput);
}

Transformed moments_of(std::vector<MomentTerm> terms, const Gaussian& x) {
  MomentTape tape;
  Transformed result;
  EXPECT_TRUE(MomentMatching(std::move(terms), 1).forward(x, tape, result));
  return result;
}

TEST(Fitc, WithAllInputsInducingIsTheGp) {
  const Matrix X = gp::naive::normals(20, 3, 71);
  const gp::Hyperparameters theta = gp::naive::hyperparameters(3, 1, 1, 0.3);
  const Matrix Y = gp::naive::draw(X, theta, 72);
  const Gaussian x = tools::random_gaussian(3, 0.5, 73);
  const Transformed fitc = moments_of(fitc_terms(X, Y, X, {theta}, 1e-10), x);
  const Transformed exact = moments_of(exact_terms({gp::Inputs(X), Y, {theta}}), x);
  EXPECT_LT((fitc.mean - exact.mean).norm(), 1e-7);
  EXPECT_LT((fitc.covariance - exact.covariance).norm(), 1e-7);
  EXPECT_LT((fitc.gain - exact.gain).norm(), 1e-7);
}

}  // namespace
}  // namespace rehearse::moments
