#include "rehearse/qd/nearest_table.hpp"

#include <gtest/gtest.h>

#include "uniform_points.hpp"

namespace rehearse::qd {
namespace {

TEST(NearestTable, FindsWhatTheTreeFinds) {
  for (const Index D : {1, 2, 3})
    for (const double spread : {0.1, 1.0, 3.0}) {  // points in a corner, in the cube, mostly outside
      const Matrix points = uniform_points(D, 500, 0, spread, 1), queries = uniform_points(D, 3000, 0, 1, 2);
      const KdTree tree(points);
      const NearestTable table(tree, points);
      for (Index q = 0; q < queries.cols(); ++q)
        ASSERT_EQ(table.nearest(queries.col(q).data()), tree.nearest(queries.col(q).data())) << D << ' ' << spread;
    }
}

// Points and queries of a lattice: ties, and places on the edges of boxes.
TEST(NearestTable, OfEquallyNearPointsTheFirst) {
  Matrix points(2, 100);
  for (Index i = 0; i < 100; ++i)
    points.col(i) = Vector{{0.1 * static_cast<double>(i % 10), 0.1 * static_cast<double>(i / 10)}};
  const KdTree tree(points);
  const NearestTable table(tree, points);
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 40; ++y) {
      const Vector query{{0.025 * x, 0.025 * y}};
      ASSERT_EQ(table.nearest(query.data()), tree.nearest(query.data())) << query.transpose();
    }
}

TEST(NearestTable, KnowsNothingOutsideTheCube) {
  const Matrix points = uniform_points(2, 100, 0, 1, 1);
  const NearestTable table(KdTree(points), points);
  for (const double outside : {-1e-9, 1.0, 1e300}) EXPECT_EQ(table.nearest(Vector{{0.5, outside}}.data()), -1);
  EXPECT_TRUE(NearestTable().empty());
}

// Such points are candidates of every box: a table of them would take quadratic memory.
TEST(NearestTable, OfPointsThatCoincideOrLieFarAwayThereIsNone) {
  for (const double place : {0.5, 1e6}) {
    const Matrix points = Matrix::Constant(2, 5000, place);
    EXPECT_TRUE(NearestTable(KdTree(points), points).empty());
  }
}

}  // namespace
}  // namespace rehearse::qd
