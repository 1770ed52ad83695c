#include "rehearse/moments/moment_narrow.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "matching_cases.hpp"

namespace rehearse::moments {
namespace {

using matching::matched_moments;

/// Two smooth functions without noise, with the largest signal-to-noise ratio that fits give.
gp::Posterior exact_data(std::uint64_t seed, double noise = 1e-5) {
  const Matrix X = gp::naive::normals(100, 3, seed);
  const std::vector<gp::Hyperparameters> theta{gp::naive::hyperparameters(3, 1.5, 1, noise),
                                               gp::naive::hyperparameters(3, 2.5, 1, noise)};
  Matrix Y(100, 2);
  for (Index e = 0; e < 2; ++e)
    Y.col(e) = (X.col(0) + static_cast<double>(e) * X.col(1)).array().sin() * X.col(2).array().cos();
  return {gp::Inputs(X), Y, theta};
}

Gaussian around(const Matrix& rows, Index i, double deviation) {
  return {rows.row(i).transpose(), deviation * deviation * Matrix::Identity(3, 3)};
}

TEST(MomentNarrow, OfACertainInputIsThePredictionOfExactData) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    const gp::Posterior posterior = exact_data(seed);
    const MomentMatching matching(exact_terms(posterior), 2);
    const Matrix at = gp::naive::normals(20, 3, 100 + seed);
    Matrix mean(20, 2), variance(20, 2);
    posterior.predict(at, mean, variance);
    for (Index i = 0; i < 20; ++i) {
      const Transformed result = matched_moments(matching, {at.row(i).transpose(), Matrix::Zero(3, 3)});
      EXPECT_GE(result.covariance.diagonal().minCoeff(), 0);
      EXPECT_LT((result.covariance.diagonal() - variance.row(i).transpose()).norm(), 1e-12);
      EXPECT_EQ(result.covariance(0, 1), 0);
    }
  }
}

/// ½ Σ_d ∂²s²/∂x_d² of the predictive variances at a point, by differences.
Vector half_laplacian(const gp::Posterior& posterior, const Matrix& at) {
  const double step = 0.01;
  Matrix mean(1, 2), middle(1, 2), beside(1, 2);
  posterior.predict(at, mean, middle);
  Vector sum = Vector::Zero(2);
  for (Index d = 0; d < 3; ++d)
    for (const double sign : {-1.0, 1.0}) {
      Matrix moved = at;
      moved(0, d) += sign * step;
      posterior.predict(moved, mean, beside);
      sum += (beside - middle).transpose() / (2 * step * step);
    }
  return sum;
}

TEST(MomentNarrow, CovariancesOfNarrowInputsArePositiveAndGrowAsTheSlopesSay) {
  const gp::Posterior posterior = exact_data(1);
  const MomentMatching matching(exact_terms(posterior), 2);
  const Matrix at = gp::naive::normals(10, 3, 3);
  for (Index i = 0; i < 10; ++i) {
    const Vector curvature = half_laplacian(posterior, at.row(i));
    const Matrix certain = matched_moments(matching, around(at, i, 0)).covariance;
    for (const double deviation : {1e-8, 1e-6, 1e-4, 1e-3}) {
      const Gaussian x = around(at, i, deviation);
      const Transformed result = matched_moments(matching, x);
      Matrix growth = result.gain.transpose() * x.covariance * result.gain;
      growth.diagonal() += deviation * deviation * curvature;
      const Eigen::SelfAdjointEigenSolver<Matrix> solver(result.covariance);
      EXPECT_GE(solver.eigenvalues()(0), -1e-13) << deviation;
      EXPECT_LT((result.covariance - certain - growth).norm(), 1e-12 + 1e-3 * growth.norm()) << deviation;
    }
  }
}

/// Well-conditioned moments and their slopes are the same by both ways.
TEST(MomentNarrow, AgreesWithAllPairs) {
  const gp::Posterior posterior = exact_data(2, 0.3);
  std::vector<MomentTerm> terms = exact_terms(posterior), plain = terms;
  for (MomentTerm& term : terms) EXPECT_LT((term.factor.transpose() * term.factor - term.reduction).norm(), 1e-8);
  for (MomentTerm& term : plain) term.factor.resize(0, 0);
  const MomentMatching narrow(terms, 2), wide(plain, 2);
  const Gaussian x = around(gp::naive::normals(1, 3, 4), 0, 3e-5);
  const Transformed by = tools::random_adjoint(3, 2, 5);
  Gaussian adjoints[2] = {Gaussian::zero(3), Gaussian::zero(3)};
  Transformed results[2];
  for (const int k : {0, 1}) {
    MomentTape tape;
    ASSERT_TRUE((k ? wide : narrow).forward(x, tape, results[k]));
    EXPECT_EQ(std::isnan(tape.covariances(0)), k == 1);
    (k ? wide : narrow).adjoint(x, tape, results[k], by, adjoints[k]);
  }
  EXPECT_LT((results[0].covariance - results[1].covariance).norm(), 1e-11);
  EXPECT_LT((adjoints[0].mean - adjoints[1].mean).norm(), 1e-7);
  EXPECT_LT((adjoints[0].covariance - adjoints[1].covariance).norm(), 1e-5);
}

TEST(MomentNarrow, LimitsGrowWithTheRounding) {
  const MomentTerm rough = exact_terms(exact_data(3, 0.1))[0], fine = exact_terms(exact_data(3, 1e-5))[0];
  EXPECT_LT(narrow_limit(rough, rough), 1e-5);
  EXPECT_GT(narrow_limit(fine, fine), 1e-4);
  EXPECT_LT(narrow_limit(fine, fine), 1);
}

TEST(MomentNarrow, NoCrossTermExceedsTheLimit) {
  const Matrix Z = gp::naive::normals(30, 2, 6), root = gp::naive::normals(2, 2, 7), form = root * root.transpose();
  const double largest = (2 * Z * form * Z.transpose()).cwiseAbs().maxCoeff();
  EXPECT_FALSE(crosses_within(Z, form, Z, form, largest * (1 - 1e-12)));
  EXPECT_TRUE(crosses_within(Z, form, Z, form, largest * (1 + 1e-12)));
  EXPECT_TRUE(crosses_within(Z, Matrix::Zero(2, 2), Z, Matrix::Zero(2, 2), 0));
}

}  // namespace
}  // namespace rehearse::moments
