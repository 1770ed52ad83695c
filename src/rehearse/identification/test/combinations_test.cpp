#include "rehearse/identification/combinations.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse::identification {
namespace {

using Names = std::vector<std::string>;

/// n points, each made of two numbers in [0.2, 1].
Matrix points(Index n, const std::function<Vector(double, double)>& make) {
  Rng rng({.seed = 1});
  Matrix all(make(0.5, 0.5).size(), n);
  for (Index k = 0; k < n; ++k) {
    const double a = rng.uniform(0.2, 1), b = rng.uniform(0.2, 1);
    all.col(k) = make(a, b);
  }
  return all;
}

TEST(KnownCombinations, NamesSumsAndProductsAlongARidge) {
  const Matrix ridge = points(20, [](double a, double) { return Vector{{1.24 - a, a, 0.1 / a, 0.11 - 0.09 * a}}; });
  EXPECT_EQ(known_combinations({"m1", "m2", "r2", "I1"}, ridge, 1),
            (Names{"m1 + m2 = 1.24", "r2·m2 = 0.1", "I1 + 0.09·m2 = 0.11"}));
}

TEST(KnownCombinations, NamesDifferencesRatiosAndPowers) {
  const Matrix ridge = points(20, [](double a, double) { return Vector{{a + 0.3, 2 * a, a * a}}; });
  EXPECT_EQ(known_combinations({"x", "y", "z"}, ridge, 1), (Names{"x − 0.5·y = 0.3", "z/y^2 = 0.25"}));
}

TEST(KnownCombinations, AreTrueAsTheyArePrinted) {
  const Matrix ridge = points(20, [](double a, double) { return Vector{{5 - 1.019 * (100 + a), 100 + a}}; });
  const double mean = (ridge.row(0) + ridge.row(1)).mean();
  EXPECT_EQ(known_combinations({"x", "y"}, ridge, 1), Names{fmt::format("y + x = {:.3g}", mean)});
}

TEST(KnownCombinations, NamesWhatTwoUnknownDirectionsLeave) {
  const Matrix plane = points(30, [](double a, double b) { return Vector{{a, b, 2 - a - b}}; });
  EXPECT_EQ(known_combinations({"a", "b", "c"}, plane, 2), (Names{"c + a + b = 2"}));
  EXPECT_EQ(known_combinations({"a", "b", "c"}, plane, 1), Names{}) << "no more unknown directions than there are";
}

TEST(KnownCombinations, NamesThoseThatAreSimpleWhereOthersAreNot) {
  const Matrix all = points(30, [](double a, double b) { return Vector{{a, b, 3 * a, std::sin(9 * a) * b}}; });
  EXPECT_EQ(known_combinations({"k", "m", "b", "I"}, all, 2), Names{"b/k = 3"});
}

TEST(KnownCombinations, IsSilentWhereNothingSimpleIsKnown) {
  const Matrix wave = points(30, [](double a, double) { return Vector{{a, std::sin(12 * a)}}; });
  EXPECT_EQ(known_combinations({"a", "b"}, wave, 1), Names{});
  const Matrix apart = points(30, [](double a, double b) { return Vector{{a, b}}; });
  EXPECT_EQ(known_combinations({"a", "b"}, apart, 2), Names{});
  EXPECT_EQ(known_combinations({"a", "b"}, Matrix(2, 0), 1), Names{});
}

}  // namespace
}  // namespace rehearse::identification
