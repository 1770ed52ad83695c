#include "rehearse/gp/cholesky.hpp"

#include <gtest/gtest.h>

#include "naive.hpp"
#include "rehearse/core/test/tile_tools.hpp"
#include "rehearse/gp/kernel.hpp"

namespace rehearse::gp {
namespace {

struct Result {
  double jitter;
  Matrix lower;
};

Result factorise(const Matrix& X, double noise_ratio) {
  const Index n = X.rows();
  std::vector<double> scaled(static_cast<std::size_t>(padded(n) * X.cols())),
      tiles(static_cast<std::size_t>(tiles_size(n)));
  const Vector ones = Vector::Ones(X.cols());
  scale_inputs(X.data(), n, X.cols(), ones.data(), scaled.data());
  const double jitter = gp::factorise({scaled.data(), n, X.cols(), noise_ratio}, tiles.data());
  return {jitter, lower_from_tiles(n, tiles)};
}

TEST(Cholesky, NeedsNoJitterWithNoise) {
  const Matrix X = naive::normals(60, 3, 1);
  const Result result = factorise(X, 1e-4);
  EXPECT_EQ(result.jitter, 0);
  const Hyperparameters theta{.log_lengths = Vector::Zero(3), .log_signal = 0, .log_noise = std::log(1e-2)};
  EXPECT_TRUE((result.lower * result.lower.transpose()).isApprox(naive::noisy_covariance(X, theta), 1e-14));
}

TEST(Cholesky, ClimbsTheLadderForDuplicatesWithoutNoise) {
  const Result result = factorise(Matrix::Zero(50, 2), 0);
  EXPECT_GT(result.jitter, 0);
  EXPECT_LE(result.jitter, 1e-8);
  EXPECT_TRUE(result.lower.allFinite());
}

TEST(Cholesky, SaysWhenNoRungIsEnough) { EXPECT_TRUE(std::isnan(factorise(naive::normals(5, 2, 1), -2).jitter)); }

}  // namespace
}  // namespace rehearse::gp
