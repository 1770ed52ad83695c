#include "rehearse/moments/linearised_prior.hpp"

#include <gtest/gtest.h>

#include "priors.hpp"

namespace rehearse::moments {
namespace {

TEST(LinearisedPrior, OfALineIsTheClosedForm) { priors::expect_exact_of_a_line(Through::linearised); }

// The covariance is small: curvature within it is below the errors of 200 000 samples.
TEST(LinearisedPrior, OfANarrowGaussianIsThatOfSamples) {
  const Gaussian x = tools::random_gaussian(priors::kInputs, 1e-7, 2);
  const auto change = [](const Vector& at, const Vector&) { return priors::bend(at); };
  tools::expect_samples(change, x, priors::through(*priors::moments(priors::bend, Through::linearised), x), 3);
}

TEST(LinearisedPrior, ItsMeanIsThatOfThePriorAtTheMean) {
  const Gaussian x = tools::random_gaussian(priors::kInputs, 1, 4);
  EXPECT_EQ(priors::through(*priors::moments(priors::bend, Through::linearised), x).mean, priors::bend(x.mean));
}

TEST(LinearisedPrior, AdjointAgreesWithDifferences) {
  priors::expect_adjoint(tools::random_gaussian(priors::kInputs, 0.3, 6), Through::linearised, 2e-6);
  priors::expect_adjoint(tools::random_gaussian(priors::kInputs, 2, 7), Through::linearised, 2e-6);
}

}  // namespace
}  // namespace rehearse::moments
