#include "rehearse/gp/odd.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "naive.hpp"
#include "predict.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::gp {
namespace {

const Vector kOddSigns{{-1, 1, -1}};

Matrix images(const Matrix& X) { return X * kOddSigns.asDiagonal(); }

Matrix odd(const Matrix& A, const Matrix& B, const Hyperparameters& theta) {
  return naive::covariance(A, B, theta) - naive::covariance(A, images(B), theta);
}

Matrix noisy(const Matrix& X, const Hyperparameters& theta) {
  return odd(X, X, theta) + theta.noise_variance() * Matrix::Identity(X.rows(), X.rows());
}

/// Inputs that are not centred, so that images are not where the unit inputs' opposites are.
Matrix inputs(Index n, std::uint64_t seed) { return naive::normals(n, 3, seed).array() + 0.4; }

std::vector<Hyperparameters> thetas(bool trend) {
  std::vector<Hyperparameters> all = {naive::hyperparameters(3, 1, 2, 0.1), naive::hyperparameters(3, 3, 0.5, 0.01)};
  for (Hyperparameters& theta : all)
    if (trend) theta = naive::with_trend(theta, 0.3 * std::exp(theta.log_signal / 2));
  return all;
}

Matrix targets(const Matrix& X, const std::vector<Hyperparameters>& all) {
  Matrix Y(X.rows(), static_cast<Index>(all.size()));
  for (Index e = 0; e < Y.cols(); ++e)
    Y.col(e) = noisy(X, all[static_cast<std::size_t>(e)]).llt().matrixL() * Vector(naive::normals(X.rows(), 1, 5));
  return Y;
}

TEST(Odd, CovarianceAndEvidenceAreTheBooks) {
  const Matrix X = inputs(40, 1);
  for (const bool trend : {false, true}) {
    for (const Hyperparameters& theta : thetas(trend)) {
      const Matrix expected = odd(X, X, theta) / theta.signal_variance();
      EXPECT_LT((odd_covariance(Inputs(X), kOddSigns, theta) - expected).cwiseAbs().maxCoeff(),
                1e-12 * expected.norm());
      const Vector y = naive::normals(40, 1, 2);
      const Eigen::LLT<Matrix> llt(noisy(X, theta));
      const double evidence =
          -0.5 * y.dot(llt.solve(y)) - llt.matrixLLT().diagonal().array().log().sum() - 20 * std::log(2 * M_PI);
      EXPECT_NEAR(odd_evidence(Inputs(X), kOddSigns, y, theta).value, evidence, 1e-8 * std::abs(evidence));
    }
  }
}

TEST(Odd, WhatCannotBeComputedIsNaN) {
  const Vector y{{kNaN}};
  EXPECT_FALSE(odd_evidence(Inputs(inputs(1, 1)), kOddSigns, y, thetas(false)[0]).ok());
}

TEST(Odd, PosteriorsAreTheBooks) {
  for (const bool trend : {false, true}) {
    for (const Index n : {1, 33, 130}) {
      const Matrix X = inputs(n, 3), F = inputs(150, 4);
      const std::vector<Hyperparameters> all = thetas(trend);
      const Matrix Y = targets(X, all);
      const Posterior posterior(Inputs(X), Y, all, 0, kOddSigns);
      const Prediction p = predict(posterior, F), q = predict(posterior, images(F));
      Matrix means(F.rows(), 2);
      posterior.predict_mean(F, means);
      EXPECT_EQ(p.mean, means);
      for (Index e = 0; e < 2; ++e) {
        const Hyperparameters& theta = all[static_cast<std::size_t>(e)];
        const Eigen::LLT<Matrix> llt(noisy(X, theta));
        const Matrix k = odd(X, F, theta);
        const Vector mean = k.transpose() * llt.solve(Y.col(e));
        const Vector before = odd(F, F, theta).diagonal();
        const Vector variance = before - Vector(llt.matrixL().solve(k).colwise().squaredNorm());
        EXPECT_LT((p.mean.col(e) - mean).norm(), 1e-9 * (1 + mean.norm())) << trend << n << e;
        EXPECT_LT((p.variance.col(e) - variance).norm(), 1e-9 * (1 + before.norm())) << trend << n << e;
        EXPECT_LT((p.mean + q.mean).col(e).norm(), 1e-9 * (1 + mean.norm()));
        EXPECT_LT((p.variance - q.variance).col(e).norm(), 1e-9 * (1 + before.norm()));
        EXPECT_NEAR(posterior.log_evidences()(e), odd_evidence(Inputs(X), kOddSigns, Y.col(e), theta).value, 1e-9 * n);
      }
    }
  }
}

TEST(Odd, FewPointsStandForAll) {
  const Matrix X = naive::normals(220, 2, 17).array() + 0.3, F = 2 * naive::normals(500, 2, 19);
  const Vector signs{{-1, -1}};
  for (const double trend : {0.0, 0.4}) {
    Hyperparameters theta = naive::hyperparameters(2, 2, 1, 0.3);
    if (trend > 0) theta = naive::with_trend(theta, trend);
    const Vector y = (X.col(0).array() * 1.5).sin() * X.col(1).array().cos() + 0.3 * naive::normals(220, 1, 18).array();
    const Posterior all(Inputs(X), y, {theta}, 0, signs), few(Inputs(X), y, {theta}, 0.01, signs);
    EXPECT_LT(few.variance_points(0), 110) << trend;
    const Prediction p = predict(all, F), q = predict(few, F);
    const Eigen::ArrayXd scale = q.variance.col(0).cwiseSqrt().cwiseMax(1);
    EXPECT_LT(((p.mean - q.mean).col(0).array().abs() / scale).maxCoeff(), 0.01 * 0.3) << trend;
    const Vector deviations = p.variance.col(0).cwiseSqrt() - q.variance.col(0).cwiseSqrt();
    EXPECT_LT((deviations.array().abs() / scale).maxCoeff(), 0.01 * 0.3) << trend;
  }
}

TEST(Odd, NothingIsKnownFarAwayAndRowsStayAlone) {
  const Matrix X = inputs(50, 3);
  const std::vector<Hyperparameters> all = thetas(false);
  const Posterior posterior(Inputs(X), targets(X, all), all, 0.01, kOddSigns);
  const Matrix F{{1e6, 0, 0}, {kInf, 0, -kInf}, {1e308, 1, 1}, {kNaN, 0, 0}, {0, 1, 0}};
  const Prediction p = predict(posterior, F);
  for (Index e = 0; e < 2; ++e) {
    for (Index i = 0; i < 3; ++i) {
      EXPECT_EQ(p.mean(i, e), 0) << i;
      EXPECT_DOUBLE_EQ(p.variance(i, e), all[static_cast<std::size_t>(e)].signal_variance()) << i;
    }
    EXPECT_TRUE(std::isnan(p.mean(3, e)) && std::isnan(p.variance(3, e)));
    EXPECT_NEAR(p.mean(4, e), 0, 1e-12);  // its own image
    EXPECT_NEAR(p.variance(4, e), 0, 1e-12);
  }
  EXPECT_EQ(predict(posterior, F.bottomRows(1)).mean, p.mean.bottomRows(1));
}

TEST(Odd, SignsAreCounted) {
  EXPECT_THROW(Posterior(Inputs(inputs(5, 1)), Matrix::Zero(5, 2), thetas(false), 0, Vector{{1, -1}}), InvalidInput);
}

}  // namespace
}  // namespace rehearse::gp
