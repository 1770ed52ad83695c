#include "rehearse/qd/niches.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/test/test_tools.hpp"

namespace rehearse::qd {
namespace {

Index find(const Niches& niches, const Vector& descriptor) { return niches.find(descriptor.data()); }

TEST(Grid, HasAsManyBinsOfEachDescriptorAsItIsGiven) {
  const Niches grid(Grid{{{0, 1}, {-1, 1}, {10, 30}}, {2, 3, 5}});
  EXPECT_EQ(grid.size(), 30);
  EXPECT_TRUE(grid.is_grid());
  for (Index niche = 0; niche < grid.size(); ++niche) EXPECT_EQ(find(grid, grid.centre(niche)), niche);
  EXPECT_TRUE(grid.centre(0).isApprox(Vector{{0.25, -2.0 / 3, 12}}));
  EXPECT_EQ(find(grid, Vector{{0, -1, 10}}), 0);
  EXPECT_EQ(find(grid, Vector{{1, 1, 30}}), 29);
  EXPECT_EQ(find(grid, Vector{{0.5, -1, 10}}), 15);
  EXPECT_EQ(find(grid, Vector{{-7, -1e300, 10}}), 0) << "outside counts as on the border";
  EXPECT_EQ(find(grid, Vector{{7, 1e300, 1e18}}), 29);
  EXPECT_TRUE(grid.to_unit(Vector{{0.25, 0, 30}}).isApprox(Vector{{0.25, 0.5, 1}}));
}

TEST(Niches, HaveNoPlaceForWhatIsNotFinite) {
  const Niches grid(Grid{{{0, 1}, {0, 1}}, {2, 2}});
  const Niches cvt(Cvt{.bounds = {{0, 1}, {0, 1}}, .niches = 10, .samples = 100});
  for (const double bad : {std::nan(""), kInf})
    for (const Niches& niches : {grid, cvt}) EXPECT_EQ(find(niches, Vector{{0.5, bad}}), -1);
}

TEST(Cvt, FindsTheNearestCentroidInUnitsOfTheBounds) {
  const Niches cvt({{0, 1}, {0, 100}}, Matrix{{0.1, 0.9}, {10, 10}});
  EXPECT_EQ(cvt.size(), 2);
  EXPECT_EQ(find(cvt, Vector{{0.4, 90}}), 0);
  EXPECT_EQ(find(cvt, Vector{{0.6, 0}}), 1);
  EXPECT_EQ(find(cvt, Vector{{1e6, 0}}), 1);
  EXPECT_EQ(cvt.centre(1), (Vector{{0.9, 10}}));
}

TEST(Cvt, DependsOnItsSeedAndNotOnThreads) {
  const Cvt options{.bounds = {{-1, 1}, {0, 4}}, .niches = 100, .samples = 5000};
  const Niches one(options), two(options, *make_thread_evaluator(2));
  Cvt other = options;
  other.seed = 2;
  EXPECT_TRUE(one == two);
  EXPECT_FALSE(one == Niches(other));
}

/// Mean squared distance to the nearest centroid, of 10 000 points uniform in the unit square.
double distortion(Index iterations) {
  const Niches cvt(Cvt{.bounds = {{0, 1}, {0, 1}}, .niches = 100, .samples = 10000, .iterations = iterations});
  Rng rng({.seed = 5});
  double sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vector point{{rng.uniform(), rng.uniform()}};
    sum += (point - cvt.centre(find(cvt, point))).squaredNorm();
  }
  return sum / 10000;
}

// The distortion of 100 random points is 1/(100 π) = 0.0032 on average and more at the edges, that of hexagons (the
// best) 0.0016.
TEST(Cvt, SpreadsItsCentroidsEvenly) {
  EXPECT_GT(distortion(0), 0.0025);
  EXPECT_LT(distortion(30), 0.0018);
  EXPECT_GT(distortion(30), 0.0016);
}

TEST(Niches, RefuseWrongInputByName) {
  const std::string grid = message_of<InvalidInput>([] { Niches(Grid{{{0, 1}, {1, 1}}, {2, 0}}); });
  EXPECT_NE(grid.find("descriptor 2: bounds [1, 1], must be finite with low < high"), std::string::npos) << grid;
  EXPECT_NE(grid.find("descriptor 2: 0 bins, must be ≥ 1"), std::string::npos) << grid;
  EXPECT_NE(message_of<InvalidInput>([] {
              Niches(Grid{{{0, 1}}, {2, 3}});
            }).find("bins of 2 descriptors, must be of 1"),
            std::string::npos);
  EXPECT_NE(message_of<InvalidInput>([] {
              Niches(Grid{std::vector<Interval>(10, {0, 1}), std::vector<Index>(10, 10)});
            }).find("the grid has 1e+10 niches, must be ≤ 1e+08"),
            std::string::npos);
  EXPECT_NE(message_of<InvalidInput>([] {
              Niches(Cvt{.bounds = {{0, 1}}, .niches = 10, .samples = 9});
            }).find("samples = 9, must be ≥ niches = 10"),
            std::string::npos);
  EXPECT_NE(message_of<InvalidInput>([] {
              Niches(Cvt{.bounds = std::vector<Interval>(65, {0, 1})});
            }).find("65 descriptors"),
            std::string::npos);
}

}  // namespace
}  // namespace rehearse::qd
