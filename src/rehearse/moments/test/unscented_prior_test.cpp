#include "rehearse/moments/unscented_prior.hpp"

#include <gtest/gtest.h>

#include "priors.hpp"

namespace rehearse::moments {
namespace {

TEST(UnscentedPrior, OfALineIsTheClosedForm) { priors::expect_exact_of_a_line(Through::unscented); }

TEST(UnscentedPrior, OfANarrowGaussianIsThatOfSamples) {
  const Gaussian x = tools::random_gaussian(priors::kInputs, 1e-7, 2);
  const auto change = [](const Vector& at, const Vector&) { return priors::bend(at); };
  Transformed moments = priors::through(*priors::moments(priors::bend, Through::unscented), x);
  // The squares of the steps of differences, 1e-6, bend the mean by as much as the curvature says.
  EXPECT_LT((moments.mean - priors::bend(x.mean)).norm(), 1e-5);
  moments.mean = priors::bend(x.mean);
  tools::expect_samples(change, x, moments, 3);
}

// A parabola's mean is moved by half its curvature times the variance, which slopes at the mean do not see.
TEST(UnscentedPrior, KnowsTheMeanOfAParabola) {
  const auto parabola = [](const Vector& x) { return Vector{{x(0) * x(0), x(0) * x(1), 0}}; };
  const Gaussian x = tools::random_gaussian(priors::kInputs, 1, 3);
  const Vector exact = parabola(x.mean) + Vector{{x.covariance(0, 0), x.covariance(0, 1), 0}};
  const Transformed change = priors::through(*priors::moments(parabola, Through::unscented), x);
  EXPECT_LT((change.mean - exact).norm(), 1e-5);
}

TEST(UnscentedPrior, WithoutCovarianceIsTheLinearisedPrior) {
  const Gaussian x{tools::normals(priors::kInputs, 1, 4), Matrix::Zero(priors::kInputs, priors::kInputs)};
  const Transformed unscented = priors::through(*priors::moments(priors::bend, Through::unscented), x);
  const Transformed linearised = priors::through(*priors::moments(priors::bend, Through::linearised), x);
  EXPECT_LT((unscented.mean - linearised.mean).norm(), 1e-5);
  EXPECT_LT((unscented.gain - linearised.gain).norm(), 1e-5);
  EXPECT_LT(unscented.covariance.norm(), 1e-9);
}

TEST(UnscentedPrior, AdjointAgreesWithDifferences) {
  priors::expect_adjoint(tools::random_gaussian(priors::kInputs, 0.3, 6), Through::unscented, 2e-5);
  priors::expect_adjoint(tools::random_gaussian(priors::kInputs, 2, 7), Through::unscented, 2e-5);
}

TEST(UnscentedPrior, HasNoMomentsWhereThereIsNoGaussian) {
  Gaussian x = tools::random_gaussian(priors::kInputs, 1, 4);
  x.covariance(1, 1) = -1;
  PriorTape tape;
  Transformed change;
  EXPECT_FALSE(priors::moments(priors::bend, Through::unscented)->forward(x, tape, change));
}

}  // namespace
}  // namespace rehearse::moments
