#include "rehearse/moments/prior_moments.hpp"

#include <gtest/gtest.h>

#include "priors.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::moments {
namespace {

using priors::kActions, priors::kInputs, priors::kStates;

TEST(PriorMoments, DifferentiatesAllStepsInOneCall) {
  Index calls = 0;
  const auto count = [&](const ConstMatrixView& X, const ConstMatrixView&, const Vector&, MatrixView dX) {
    ++calls;
    dX = X.array().sin();
  };
  for (const Through through : {Through::linearised, Through::unscented}) {
    const auto prior = make_prior_moments({"counted", system::make_simulator({}, count), {}}, {}, 2, 1, through);
    std::vector<PriorTape> tapes(3);
    std::vector<PriorTape*> all;
    std::vector<Gaussian> inputs;
    Transformed change;
    for (PriorTape& tape : tapes) {
      inputs.push_back(tools::random_gaussian(3, 0.1, inputs.size()));
      ASSERT_TRUE(prior->forward(inputs.back(), tape, change));
      all.push_back(&tape);
    }
    calls = 0;
    ASSERT_TRUE(prior->differentiate(all));
    EXPECT_EQ(calls, 1);
    for (std::size_t k = 0; k < 3; ++k) {  // as if each had been alone
      PriorTape alone;
      ASSERT_TRUE(prior->forward(inputs[k], alone, change) && prior->differentiate({&alone}));
      EXPECT_EQ(alone.nearby, tapes[k].nearby);
    }
  }
}

TEST(PriorMoments, HaveNoneWhereThePriorFailsBesideTheMean) {
  const auto edge = [](const Vector& x) { return Vector{{x(0) > 0.0001 ? kNaN : 0, 0, 0}}; };
  for (const Through through : {Through::linearised, Through::unscented}) {
    const auto prior = priors::moments(edge, through);
    PriorTape tape;
    Transformed change;
    Gaussian x = Gaussian::zero(kInputs);
    EXPECT_FALSE(prior->forward(x, tape, change));
    x.mean(0) = -1;
    EXPECT_TRUE(prior->forward(x, tape, change));
    x.mean(1) = kInf;
    EXPECT_FALSE(prior->forward(x, tape, change));
  }
}

TEST(PriorMoments, RefuseWrongSizes) {
  const auto prior = priors::moments(priors::line, Through::linearised);
  EXPECT_EQ(prior->inputs(), kInputs);
  EXPECT_EQ(prior->actions(), kActions);
  PriorTape tape;
  Transformed change;
  EXPECT_THROW(prior->forward(Gaussian::zero(kStates), tape, change), InvalidInput);
}

}  // namespace
}  // namespace rehearse::moments
