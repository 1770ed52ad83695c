#include "rehearse/moments/make_prior_moments.hpp"

#include <gtest/gtest.h>

#include "priors.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::moments {
namespace {

TEST(MakePriorMoments, GivesTheWayThatIsAsked) {
  const Gaussian x = tools::random_gaussian(priors::kInputs, 1, 4);
  EXPECT_NE(priors::through(*priors::moments(priors::bend, Through::linearised), x).mean,
            priors::through(*priors::moments(priors::bend, Through::unscented), x).mean);
}

TEST(MakePriorMoments, RefusesParametersThatThePriorDoesNotHave) {
  EXPECT_THROW(make_prior_moments(priors::prior(priors::line), Vector::Zero(1), 3, 2, Through::linearised),
               InvalidInput);
}

}  // namespace
}  // namespace rehearse::moments
