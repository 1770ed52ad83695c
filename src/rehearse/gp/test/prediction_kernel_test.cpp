#include "rehearse/gp/prediction_kernel.hpp"

#include <gtest/gtest.h>

#include "naive.hpp"

namespace rehearse::gp {
namespace {

/// Queries as the kernel wants them, column-major here: kChunk × D.
Matrix padded_queries(const Matrix& Q) {
  Matrix padded = Matrix::Zero(kChunk, Q.cols());
  padded.topRows(Q.rows()) = Q;
  return padded;
}

/// L as an inverse factor.
Matrix pack(const Matrix& L) {
  std::vector<double> tiles(static_cast<std::size_t>(tiles_size(L.rows())));
  for (Index j = 0; j < L.rows(); ++j)
    for (Index i = j; i < L.rows(); ++i) tiles[static_cast<std::size_t>(transposed_offset(i, j))] = L(i, j);
  Matrix packed(packed_size(L.rows()), 1);
  pack_inverse_factor(tiles.data(), L.rows(), packed.data());
  return packed;
}

TEST(PredictionKernel, MeansAndNorms) {
  for (const Index n : {1, 2, 6, 7, 33, 130}) {
    for (const Index rows : {1, 8, 9, 33, 64}) {
      const Index D = 4;
      const Matrix X = naive::normals(n, D, 5), Q = naive::normals(rows, D, 6), points = X.transpose();
      const Matrix L = naive::normals(n, n, 7).triangularView<Eigen::Lower>();
      const Vector w = naive::normals(n, 1, 8);
      Vector means(kChunk), norms(kChunk), means_only(kChunk);
      Matrix columns(n, kChunk);
      const Matrix queries = padded_queries(Q), packed = pack(L), expected = naive::correlations(X, Q);
      correlate({points.data()}, n, D, w.data(), {queries.data()}, rows, columns.data(), means.data());
      triangular_norms(packed.data(), n, columns.data(), rows, norms.data());
      EXPECT_LT((means.head(rows) - expected.transpose() * w).norm(), 1e-13 * (1 + w.norm()));
      const Vector expected_norms = (L * expected).colwise().squaredNorm();
      EXPECT_TRUE(norms.head(rows).isApprox(expected_norms, 1e-13)) << n << " " << rows;
      correlate({points.data()}, n, D, w.data(), {queries.data()}, rows, nullptr, means_only.data());
      EXPECT_EQ(means.head(rows), means_only.head(rows));
    }
  }
}

TEST(PredictionKernel, SolutionsAndSlopes) {
  const Index D = 3;
  for (const bool trend : {false, true}) {
    for (const Index n : {1, 7, 130}) {
      for (const Index rows : {1, 9, 64}) {
        const Matrix X = naive::normals(n, D, 5), Q = naive::normals(rows, D, 6), points = X.transpose();
        const Matrix Z = naive::normals(n, D + 1, 9), z = Z.transpose(), A = naive::normals(rows, D + 1, 10);
        const Matrix L = naive::normals(n, n, 7).triangularView<Eigen::Lower>();
        const Vector w = naive::normals(n, 1, 8);
        Vector means(kChunk), norms(kChunk), same_norms(kChunk);
        Matrix columns(n, kChunk), solved(n, kChunk), trends(n, kChunk);
        Matrix mean(kChunk, D), variance(kChunk, D), trend_sums(kChunk, D + 1);
        const Matrix queries = padded_queries(Q), of_trend = padded_queries(A), packed = pack(L);
        const KernelPoints from{points.data(), trend ? z.data() : nullptr};
        const KernelPoints to{queries.data(), trend ? of_trend.data() : nullptr};
        correlate(from, n, D, w.data(), to, rows, columns.data(), means.data());
        triangular_norms(packed.data(), n, columns.data(), rows, same_norms.data());
        triangular_solutions(packed.data(), n, columns.data(), rows, norms.data(), solved.data());
        EXPECT_EQ(norms, same_norms);
        sum_slopes(from, n, D, w.data(), to, rows, {columns.data(), solved.data(), trend ? trends.data() : nullptr},
                   {mean.data(), variance.data(), trend_sums.data()});
        const Matrix c = naive::correlations(X, Q), t = Z * A.transpose();
        const Matrix k = trend ? Matrix(c + t.cwiseAbs2()) : c, v = L.transpose() * L * k;
        for (Index d = 0; d < D; ++d) {
          const Matrix apart = X.col(d).replicate(1, rows) - Q.col(d).transpose().replicate(n, 1);
          const Matrix slope = c.cwiseProduct(apart);
          EXPECT_LT((mean.col(d).head(rows) - slope.transpose() * w).norm(), 1e-12 * (1 + k.norm() * w.norm()));
          EXPECT_LT((variance.col(d).head(rows) - slope.cwiseProduct(v).colwise().sum().transpose()).norm(),
                    1e-12 * (1 + k.norm() * v.norm()));
        }
        for (Index d = 0; trend && d <= D; ++d)
          EXPECT_LT((trend_sums.col(d).head(rows) - v.cwiseProduct(t).transpose() * Z.col(d)).norm(),
                    1e-12 * (1 + t.norm() * v.norm()));
        correlate({points.data()}, n, D, w.data(), {queries.data()}, rows, columns.data(), means.data());
        Matrix alone(kChunk, D);
        sum_slopes({points.data()}, n, D, w.data(), {queries.data()}, rows, {columns.data()},
                   {alone.data(), nullptr, nullptr});
        EXPECT_LT((alone - mean).topRows(rows).norm(), 1e-12 * (1 + k.norm() * w.norm()));
      }
    }
  }
}

TEST(PredictionKernel, PackedAndBack) {
  for (const Index n : {1, 5, 6, 7, 40}) {
    const Matrix L = naive::normals(n, n, 1), packed = pack(L);
    for (Index j = 0; j < n; ++j)
      for (Index i = j; i < n; ++i) ASSERT_EQ(packed_entry(packed.data(), i, j), L(i, j)) << n;
  }
}

// Every exponent from 0 to −80, against the library's exp: the relative error stays below 2 units of the last place.
TEST(PredictionKernel, CorrelationsAreExactToTheLastDigits) {
  const double origin = 0, one = 1;
  double worst = 0;
  for (Index block = 0; block < 2000; ++block) {
    Vector queries(kChunk), means(kChunk);
    for (Index q = 0; q < kChunk; ++q)
      queries(q) = std::sqrt(160.0 * static_cast<double>(block * kChunk + q) / (2000.0 * kChunk));
    correlate({&origin}, 1, 1, &one, {queries.data()}, kChunk, nullptr, means.data());
    for (Index q = 0; q < kChunk; ++q) {
      const double expected = std::exp(-0.5 * queries(q) * queries(q));
      worst = std::max(worst, std::abs(means(q) - expected) / expected);
    }
  }
  EXPECT_LT(worst, 4.5e-16);
}

TEST(PredictionKernel, FarPointsHaveNoCorrelationRatherThanASubnormalOne) {
  const double origin = 0, one = 1;
  Vector queries = Vector::Zero(kChunk), means(kChunk);
  queries.head(4) << 12, 13, 1e200, kInf;
  correlate({&origin}, 1, 1, &one, {queries.data()}, 4, nullptr, means.data());
  EXPECT_DOUBLE_EQ(means(0), std::exp(-72));
  EXPECT_EQ(means.segment(1, 3), Vector(Vector::Zero(3)));
}

}  // namespace
}  // namespace rehearse::gp
