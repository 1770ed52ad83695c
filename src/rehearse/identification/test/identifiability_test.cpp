#include "rehearse/identification/identifiability.hpp"

#include <gtest/gtest.h>

namespace rehearse::identification {
namespace {

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
            Sentences{"b is not determined by these trials: 0.304 to 0.696"});
}

TEST(IdentifiabilityWarnings, NamePairsAndLargerGroups) {
  Matrix pair = Matrix::Identity(3, 3);
  pair(0, 2) = pair(2, 0) = -0.98;
  EXPECT_EQ(identifiability_warnings(three(Vector{{0.1, 0.1, 0.2}}, pair)),
            (Sentences{"a and c cannot be told apart by these trials",
                       "b is not determined by these trials: 0.304 to 0.696"}));
  EXPECT_EQ(identifiability_warnings(three(Vector{{0.01, 0.01, 0.02}}, pair)), Sentences{})
      << "sure of both all the same";
  Matrix sum = Matrix::Constant(3, 3, -0.499);  // only a + b + c is known
  sum.diagonal().setOnes();
  EXPECT_EQ(identifiability_warnings(three(Vector{{0.2, 0.2, 0.2}}, sum)),
            Sentences{"a, b and c cannot be told apart by these trials"});
}

TEST(IdentifiabilityWarnings, IntervalsEndWithTheBoxAndWarningsSayWhereThatIs) {
  PhiPosterior posterior = three(Vector{{0.01, 0.02, 0.01}}, Matrix::Identity(3, 3));
  posterior.mean = Vector{{0.5, 1, 0.002}};
  const auto intervals = posterior.intervals();
  EXPECT_NEAR(intervals[0].low, 0.4804, 1e-4);
  EXPECT_NEAR(intervals[0].high, 0.5196, 1e-4);
  EXPECT_EQ(intervals[1].high, 1);
  EXPECT_EQ(intervals[2].low, 0);
  EXPECT_EQ(identifiability_warnings(posterior),
            Sentences{"b is at the end of its box, 1: a better value may lie beyond"});
}

}  // namespace
}  // namespace rehearse::identification
