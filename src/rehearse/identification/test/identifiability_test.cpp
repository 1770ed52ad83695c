#include "rehearse/identification/identifiability.hpp"

#include <gtest/gtest.h>

#include "noisy_swing.hpp"
#include "rehearse/identification/learn.hpp"

namespace rehearse::identification {
namespace {

using swing::data_with_noise;

using Sentences = std::vector<std::string>;

PhiPosterior three(const Vector& deviations, const Matrix& correlations) {
  const auto scale = deviations.asDiagonal();
  return {.parameters = {Parameter::continuous("a", 0.5, {0, 1}), Parameter::continuous("b", 0.5, {0, 1}),
                         Parameter::continuous("c", 0.5, {0, 1})},
          .mean = Vector::Constant(3, 0.5),
          .covariance = scale * correlations * scale};
}

TEST(IdentifiabilityWarnings, NameWhatIsUnsureAlone) {
  EXPECT_EQ(identifiability_warnings(three(Vector{{0.01, 0.01, 0.01}}, Matrix::Identity(3, 3))), Sentences{});
  EXPECT_EQ(identifiability_warnings(three(Vector{{0.01, 0.1, 0.01}}, Matrix::Identity(3, 3))),
            Sentences{"b is known only roughly from these data: 0.304 to 0.696"});
  EXPECT_EQ(identifiability_warnings(three(Vector{{0.01, 0.2, 0.01}}, Matrix::Identity(3, 3))),
            Sentences{"b is not determined by these data: 0.108 to 0.892"});
}

TEST(IdentifiabilityWarnings, NamePairsAndLargerGroups) {
  Matrix pair = Matrix::Identity(3, 3);
  pair(0, 2) = pair(2, 0) = -0.98;
  EXPECT_EQ(identifiability_warnings(three(Vector{{0.1, 0.1, 0.2}}, pair)),
            (Sentences{"a and c cannot be told apart by these data",
                       "b is known only roughly from these data: 0.304 to 0.696"}));
  EXPECT_EQ(identifiability_warnings(three(Vector{{0.01, 0.01, 0.02}}, pair)), Sentences{})
      << "sure of both all the same";
  Matrix sum = Matrix::Constant(3, 3, -0.499);  // only a + b + c is known
  sum.diagonal().setOnes();
  EXPECT_EQ(identifiability_warnings(three(Vector{{0.2, 0.2, 0.2}}, sum)),
            Sentences{"a, b and c cannot be told apart by these data"});
}

TEST(IdentifiabilityWarnings, IntervalsEndWithTheBoxAndWarningsSayWhereThatIs) {
  PhiPosterior posterior = three(Vector{{0.01, 0.02, 0.01}}, Matrix::Identity(3, 3));
  posterior.mean = Vector{{0.5, 1, 0.002}};
  const auto intervals = posterior.intervals();
  EXPECT_NEAR(intervals[0].low, 0.4804, 1e-4);
  EXPECT_NEAR(intervals[0].high, 0.5196, 1e-4);
  EXPECT_EQ(intervals[1].high, 1);
  EXPECT_EQ(intervals[2].low, 0);
  EXPECT_EQ(identifiability_warnings(posterior), Sentences{"b is at its bound, 1: a better value may lie beyond"});
  posterior.mean(1) = 0.9995;  // nearly the bound, but surely less
  posterior.covariance *= 1e-8;
  EXPECT_EQ(identifiability_warnings(posterior), Sentences{});
}

TEST(IdentifiabilityWarnings, AParameterThatMovesNothingCouldBeAnything) {
  const Dataset data = data_with_noise(40, 2, 0.005);
  const prior::Prior prior =
      swing::prior({swing::length(), swing::friction(), Parameter::continuous("colour", 3, {1, 5})});
  for (const Kind& kind : {Kind(GpMi{}), Kind(Mi{})}) {
    const auto posterior = learn({data, swing::features(), {}, &prior}, kind, {}, serial_evaluator()).posterior;
    const Interval interval = posterior->intervals()[2];
    EXPECT_LT(interval.high - interval.low, 4 + 1e-9);
    EXPECT_GT(interval.high - interval.low, 2.2) << "half the box and more, wherever its mean is";
    const Sentences warnings = identifiability_warnings(*posterior);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(warnings[0].starts_with("colour is not determined by these data: ")) << warnings[0];
  }
}

TEST(IdentifiabilityWarnings, AtTheEndOfTheBoxWhatLiesBeyondWidensNothing) {
  const Dataset data = data_with_noise(60, 2, 0.005);
  const prior::Prior prior =
      swing::prior({Parameter::continuous("length", 0.5, {0.3, 0.7}), swing::friction()});  // the truth is 0.8
  Mi kind;
  kind.posterior.misfit_observations = 1e12;
  const auto posterior = learn({data, swing::features(), {}, &prior}, kind, {}, serial_evaluator()).posterior;
  EXPECT_NEAR(posterior->mean(0), 0.7, 1e-6);
  EXPECT_EQ(posterior->intervals()[0].high, 0.7);
  EXPECT_GT(posterior->intervals()[0].low, 0.65);
  EXPECT_EQ(identifiability_warnings(*posterior).back(), "length is at its bound, 0.7: a better value may lie beyond");
}

TEST(IdentifiabilityWarnings, ParametersThatOnlyActTogetherCannotBeToldApart) {
  const Dataset data = data_with_noise(60, 2, 0.005);
  const prior::Prior prior =
      swing::prior({swing::length(), swing::friction(), Parameter::continuous("gear", 1.5, {0.1, 5}),
                    Parameter::continuous("motor", 1.2, {0.1, 5})},
                   [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
                     swing::ode(x, Vector{{u(0) * phi(2) * phi(3)}}, phi, dxdt);
                   });
  const auto learned = learn({data, swing::features(), {}, &prior}, GpMi{}, {}, serial_evaluator());
  EXPECT_NEAR((*learned.state.phi)(2) * (*learned.state.phi)(3), 1, 0.1);
  ASSERT_EQ(identifiability_warnings(*learned.posterior).size(), 1u);
  EXPECT_TRUE(identifiability_warnings(*learned.posterior)[0].starts_with(
      "gear and motor cannot be told apart by these data; known is motor·gear = "))
      << identifiability_warnings(*learned.posterior)[0];
}

TEST(Identifiability, AnEndIsAThousandthOfTheBox) {
  const Parameter parameter = Parameter::continuous("m", 1, {1, 3});
  EXPECT_EQ(end_at(parameter, 1.001), 1);
  EXPECT_EQ(end_at(parameter, 2.999), 3);
  EXPECT_EQ(end_at(parameter, 1.01), std::nullopt);
}

}  // namespace
}  // namespace rehearse::identification
