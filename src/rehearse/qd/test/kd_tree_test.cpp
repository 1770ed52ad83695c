#include "rehearse/qd/kd_tree.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "uniform_points.hpp"

namespace rehearse::qd {
namespace {

Index nearest_of_all(const Matrix& points, const Vector& query) {
  Index nearest = 0;
  (points.colwise() - query).colwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

TEST(KdTree, FindsWhatALookAtEveryPointFinds) {
  for (const Index D : {1, 2, 3, 6, 12})
    for (const Index n : {1, 2, 7, 50, 1000}) {
      const Matrix points = uniform_points(D, n, -1, 1, 1), queries = 1.5 * uniform_points(D, 200, -1, 1, 2);
      const KdTree tree(points);
      for (Index q = 0; q < queries.cols(); ++q)
        ASSERT_EQ(tree.nearest(queries.col(q).data()), nearest_of_all(points, queries.col(q))) << D << ' ' << n;
    }
}

// Points of a lattice, looked for from the middles between them: many are equally near.
TEST(KdTree, OfEquallyNearPointsTheFirst) {
  Matrix points(2, 100), reversed(2, 100);
  for (Index i = 0; i < 100; ++i) points.col(i) = Vector{{static_cast<double>(i % 10), static_cast<double>(i / 10)}};
  for (Index i = 0; i < 100; ++i) reversed.col(i) = points.col(99 - i);
  for (const Matrix& lattice : {points, reversed}) {
    const KdTree tree(lattice);
    for (double x = 0; x < 9; x += 0.5)
      for (double y = 0; y < 9; y += 0.5) {
        const Vector query{{x, y}};
        ASSERT_EQ(tree.nearest(query.data()), nearest_of_all(lattice, query)) << x << ' ' << y;
      }
  }
  const KdTree same(Matrix::Ones(3, 40));
  EXPECT_EQ(same.nearest(Vector::Zero(3).eval().data()), 0);
}

TEST(KdTree, StaysInItsBoundsFarAway) {
  const KdTree tree(uniform_points(2, 300, -1, 1, 1));
  for (const double far : {1e150, 1e300, -1e308}) {
    const Index found = tree.nearest(Vector{{far, -far}}.data());
    EXPECT_GE(found, 0);
    EXPECT_LT(found, 300);
  }
}

}  // namespace
}  // namespace rehearse::qd
