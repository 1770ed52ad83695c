#include "rehearse/identification/parameter_search.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/dynamics/test/swing.hpp"

namespace rehearse::identification {
namespace {

const optim::SubplexOptions kExact{.x_tolerance = 1e-9, .value_tolerance = 1e-12};

double away_from(const Vector& phi, const Vector& target) { return -(phi - target).squaredNorm(); }

TEST(Identify, SearchesTheContinuousAndLeavesTheFixed) {
  const ParameterSpace space(
      {Parameter::continuous("a", 0, {-1, 1}), Parameter::fixed("mass", 7), Parameter::continuous("b", 0, {-1, 1})});
  const auto score = [](const Vector& phi) { return away_from(phi, Vector{{0.3, 0, -0.4}}); };
  const Identified found = identify(space, {}, score, kExact);
  EXPECT_LT((found.phi - Vector{{0.3, 7, -0.4}}).norm(), 1e-4);
  EXPECT_EQ(found.score, score(found.phi));
}

TEST(Identify, OptimumOutsideTheBoxEndsAtItsBorder) {
  const ParameterSpace space({Parameter::continuous("a", 0, {-1, 1})});
  const auto score = [](const Vector& phi) { return away_from(phi, Vector{{3}}); };
  EXPECT_NEAR(identify(space, {}, score, kExact).phi(0), 1, 1e-6);
}

TEST(Identify, TriesEveryCombinationOfTheDiscreteOnce) {
  const ParameterSpace space({Parameter::discrete("a", 1, {1, 2}), Parameter::discrete("b", 1, {1, 2, 3})});
  std::vector<Vector> tried;
  const auto score = [&](const Vector& phi) {
    tried.push_back(phi);
    return away_from(phi, Vector{{2, 2}});
  };
  const Identified found = identify(space, {}, score, {});
  EXPECT_EQ(found.phi, (Vector{{2, 2}}));
  EXPECT_EQ(found.evaluations, 6);
  EXPECT_EQ(tried.size(), 6u);
}

TEST(Identify, EachCombinationHasItsOwnContinuousOptimum) {
  const ParameterSpace space({Parameter::discrete("which", 0, {0, 1, 2}), Parameter::continuous("a", 0, {-3, 3})});
  const auto score = [](const Vector& phi) {  // which = 1 has the best optimum, at a = 1
    return (phi(0) == 1 ? 1.0 : 0.5) - std::abs(phi(1) - phi(0));
  };
  const Identified found = identify(space, {}, score, kExact);
  EXPECT_EQ(found.phi(0), 1);
  EXPECT_NEAR(found.phi(1), 1, 1e-5);
}

TEST(Identify, StartsWhereItIsTold) {
  const ParameterSpace space({Parameter::continuous("a", 0, {-1, 1})});
  double first = kNaN;
  const auto score = [&](const Vector& phi) {
    if (std::isnan(first)) first = phi(0);
    return away_from(phi, Vector{{0.5}});
  };
  identify(space, Vector{{0.4}}, score, {});
  EXPECT_EQ(first, 0.4);
}

TEST(Identify, NoTunableParameterIsOneEvaluation) {
  const ParameterSpace space = ParameterSpace({Parameter::continuous("a", 0.2, {-1, 1})}).fixed_at(Vector{{0.2}});
  const Identified found = identify(space, {}, [](const Vector&) { return 3.0; }, {});
  EXPECT_EQ(found.phi, (Vector{{0.2}}));
  EXPECT_EQ(found.evaluations, 1);
  EXPECT_EQ(found.score, 3);
}

TEST(Identify, SurvivesScoresThatAreNotFinite) {
  const ParameterSpace space({Parameter::continuous("a", 0, {-1, 1})});
  const auto score = [](const Vector& phi) { return phi(0) > 0.3 ? kNaN : away_from(phi, Vector{{0.25}}); };
  EXPECT_NEAR(identify(space, {}, score, kExact).phi(0), 0.25, 1e-3);
  const auto never = [](const Vector&) { return -kInf; };
  EXPECT_EQ(identify(space, Vector{{0.7}}, never, {}).phi, (Vector{{0.7}})) << "nothing is better than the start";
}

}  // namespace
}  // namespace rehearse::identification
