#include "rehearse/gp/posterior.hpp"

#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "naive.hpp"
#include "predict.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"

namespace rehearse::gp {
namespace {

std::vector<Hyperparameters> three_outputs(Index D) {
  return {naive::hyperparameters(D, 1, 2, 0.1), naive::hyperparameters(D, 3, 0.5, 0.01),
          naive::hyperparameters(D, 0.3, 1, 1e-3)};
}

Posterior make(Index n, Index D, double tolerance = 0) {
  const Matrix X = naive::normals(n, D, 1);
  return Posterior(Inputs(X), naive::normals(n, 3, 2), three_outputs(D), tolerance);
}

/// Two inputs whose functions are so smooth that a few points sum them up, but for the third output: its noise hides
/// nothing.
Posterior smooth(Index n, double tolerance) {
  const Matrix X = naive::normals(n, 2, 17);
  std::vector<Hyperparameters> thetas = {naive::hyperparameters(2, 2, 1, 0.5), naive::hyperparameters(2, 2, 2, 0.02),
                                         naive::hyperparameters(2, 0.1, 1, 1e-6)};
  Matrix Y(n, 3);
  for (Index e = 0; e < 3; ++e) Y.col(e) = naive::draw(X, thetas[static_cast<std::size_t>(e)], 18);
  return Posterior(Inputs(X), Y, std::move(thetas), tolerance);
}

void expect_the_book(bool trend) {
  for (const Index n : {1, 2, 40, 64, 130}) {
    for (const Index D : {1, 7}) {
      const Matrix X = naive::normals(n, D, 3).array() * 2 + 5, F = naive::normals(90, D, 4).array() * 2 + 5;
      std::vector<Hyperparameters> thetas = three_outputs(D);
      for (Hyperparameters& theta : thetas)
        if (trend) theta = naive::with_trend(theta, 0.3 * std::exp(theta.log_signal / 2));
      Matrix Y(n, 3);
      for (Index e = 0; e < 3; ++e) Y.col(e) = naive::draw(X, thetas[static_cast<std::size_t>(e)], 5);
      const Posterior posterior(Inputs(X), Y, thetas);
      const Prediction p = predict(posterior, F);
      for (Index e = 0; e < 3; ++e) {
        const Hyperparameters& theta = thetas[static_cast<std::size_t>(e)];
        const Eigen::LLT<Matrix> llt(naive::noisy_covariance(X, theta));
        const Matrix k = naive::covariance(X, F, theta);
        const Vector mean = k.transpose() * llt.solve(Y.col(e));
        const Vector explained = llt.matrixL().solve(k).colwise().squaredNorm();
        const double tolerance = theta.log_noise < -6 ? 1e-8 : 1e-10;  // the condition grows with 1/σ_n²
        EXPECT_LT((p.mean.col(e) - mean).norm(), tolerance * (1 + mean.norm())) << n << " " << D << " " << e;
        const Vector before = naive::covariance(F, F, theta).diagonal();
        EXPECT_LT((p.variance.col(e) - (before - explained)).norm(), tolerance * (1 + trend * before.norm()));
        EXPECT_NEAR(posterior.log_evidences()(e), naive::evidence(X, Y.col(e), theta), 1e-7 * n);
        EXPECT_DOUBLE_EQ(posterior.noise_variances()(e), theta.noise_variance());
      }
    }
  }
}

TEST(Posterior, AgreesWithTheBook) { expect_the_book(false); }
TEST(Posterior, WithATrendAgreesWithTheBook) { expect_the_book(true); }

TEST(Posterior, ExposesWhatMomentMatchingNeeds) {
  const Matrix X = naive::normals(20, 2, 6), Y = naive::normals(20, 1, 7);
  const Hyperparameters theta = naive::hyperparameters(2, 1, 2, 0.1);
  const Posterior posterior(Inputs(X), Y, {theta});
  const Matrix K = naive::noisy_covariance(X, theta), L = posterior.inverse_factor(0);
  EXPECT_TRUE((L.transpose() * L).isApprox(4 * K.inverse(), 1e-9));
  EXPECT_TRUE(Vector(posterior.weights(0)).isApprox(4 * K.llt().solve(Y), 1e-9));
}

TEST(Posterior, WithinTheToleranceFewPointsStandForAll) {
  const Index n = 220;
  const double tolerance = 0.01;
  const Posterior exact = smooth(n, 0), few = smooth(n, tolerance);
  Matrix F(3000, 2);
  F << naive::normals(1000, 2, 19), 3 * naive::normals(1000, 2, 20), naive::normals(n, 2, 17).replicate(4, 1),
      20 * naive::normals(120, 2, 21);
  const Prediction a = predict(exact, F), b = predict(few, F);
  for (Index e = 0; e < 3; ++e) {
    const double noise = std::sqrt(exact.noise_variances()(e));
    const Vector difference = a.variance.col(e).cwiseSqrt() - b.variance.col(e).cwiseSqrt();
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), tolerance * noise) << e;
    EXPECT_LT((a.mean.col(e) - b.mean.col(e)).cwiseAbs().maxCoeff(), tolerance * noise) << e;
    EXPECT_EQ(exact.variance_points(e), n);
  }
  EXPECT_LT(few.variance_points(0), n / 4);
  EXPECT_LT(few.variance_points(1), n / 2);
  EXPECT_EQ(few.variance_points(2), n);
  EXPECT_EQ(few.log_evidences(), exact.log_evidences());
}

// Far from the data of a trend s̃ exceeds σ_f by far: the errors grow with it, as the header says, and do exceed
// tolerance · σ_n there.
TEST(Posterior, TheToleranceHoldsInUnitsOfTheUncertaintyOfATrend) {
  const Index n = 220;
  const double tolerance = 0.01;
  const Matrix X = naive::normals(n, 2, 17);
  Matrix F(1500, 2);
  F << naive::normals(500, 2, 19), 5 * naive::normals(500, 2, 20), 200 * naive::normals(500, 2, 21);
  double beyond = 0;
  for (const double trend : {0.3, 3.0}) {
    for (const double noise : {0.5, 0.15, 0.02, 1e-3}) {
      const Hyperparameters theta = naive::with_trend(naive::hyperparameters(2, 2, 1, noise), trend);
      const Vector y = naive::draw(X, theta, 18);
      const Prediction a = predict(Posterior(Inputs(X), y, {theta}), F);
      const Posterior few(Inputs(X), y, {theta}, tolerance);
      const Prediction b = predict(few, F);
      EXPECT_LT(few.variance_points(0), noise > 0.1 ? n / 2 : n + 1) << trend << " " << noise;
      const Eigen::ArrayXd uncertainty = b.variance.col(0).cwiseSqrt(), scale = uncertainty.max(1.0);
      const Eigen::ArrayXd mean_error = (a.mean - b.mean).col(0).cwiseAbs();
      const Eigen::ArrayXd deviation_error = (a.variance.col(0).array().sqrt() - uncertainty).abs();
      EXPECT_LE((mean_error / scale).maxCoeff(), tolerance * noise) << trend << " " << noise;
      EXPECT_LE((deviation_error / uncertainty).maxCoeff(), tolerance) << trend << " " << noise;
      if (noise < 0.1) continue;
      EXPECT_LE((deviation_error / scale).maxCoeff(), tolerance * noise) << trend << " " << noise;
      beyond = std::max(beyond, deviation_error.maxCoeff() / (tolerance * noise));
    }
  }
  EXPECT_GT(beyond, 1) << "the bound without s̃ would do";
}

TEST(Posterior, ARowIsTheSameToTheBitHoweverManyComeWithIt) {
  for (const Index n : {1, 5, 50, 130, 200, 331, -200}) {
    const Posterior posterior = n > 0 ? make(n, 7) : smooth(-n, 0.01);
    const Matrix F = naive::normals(200, posterior.dimensions(), 8);
    const Prediction all = predict(posterior, F);
    Matrix means(200, 3);
    posterior.predict_mean(F, means);
    EXPECT_EQ(all.mean, means);
    for (const auto& [first, count] :
         {std::pair<Index, Index>{0, 1}, {3, 64}, {100, 1}, {63, 2}, {199, 1}, {17, 130}}) {
      const Prediction some = predict(posterior, F.middleRows(first, count));
      EXPECT_EQ(some.mean, all.mean.middleRows(first, count)) << n << " " << first;
      EXPECT_EQ(some.variance, all.variance.middleRows(first, count)) << n << " " << first;
      Matrix few(count, 3);
      posterior.predict_mean(F.middleRows(first, count), few);
      EXPECT_EQ(few, some.mean);
    }
  }
}

TEST(Posterior, TwoThreadsGiveTheSameBytes) {
  const Posterior posterior = make(150, 5);
  const Matrix F = naive::normals(500, 5, 9);
  const Prediction expected = predict(posterior, F);
  const auto repeat = [&](bool& same) {
    same = true;
    for (int k = 0; k < 20; ++k) {
      const Prediction p = predict(posterior, F);
      same = same && p.mean == expected.mean && p.variance == expected.variance;
    }
  };
  bool same[2];
  std::thread other(repeat, std::ref(same[1]));
  repeat(same[0]);
  other.join();
  EXPECT_TRUE(same[0] && same[1]);
}

TEST(Posterior, OneThreadUsesManyPosteriorsInTurn) {
  const Posterior small = make(9, 2), large = make(140, 6);
  const Matrix few = naive::normals(3, 2, 10), many = naive::normals(100, 6, 11);
  const Posterior odd(Inputs(naive::normals(30, 3, 1)), naive::normals(30, 3, 2), three_outputs(3), 0,
                      Vector{{-1, 1, -1}});
  const Prediction first = predict(small, few), of_odd = predict(odd, many.leftCols(3));
  predict(large, many);
  const Prediction again = predict(small, few), of_odd_again = predict(odd, many.leftCols(3));
  EXPECT_EQ(first.mean, again.mean);
  EXPECT_EQ(first.variance, again.variance);
  EXPECT_EQ(of_odd.mean, of_odd_again.mean);
  EXPECT_EQ(of_odd.variance, of_odd_again.variance);
}

TEST(Posterior, MissingRowsStayAlone) {
  const Posterior posterior = make(70, 4, 0.01);
  Matrix F = naive::normals(130, 4, 12);
  const Prediction clean = predict(posterior, F);
  F(7, 2) = F(129, 0) = kNaN;
  const Prediction p = predict(posterior, F);
  Matrix means(130, 3);
  posterior.predict_mean(F, means);
  for (Index i = 0; i < 130; ++i) {
    const bool missing = i == 7 || i == 129;
    EXPECT_EQ(p.mean.row(i).array().isNaN().all(), missing) << i;
    EXPECT_EQ(p.variance.row(i).array().isNaN().all(), missing) << i;
    EXPECT_EQ(means.row(i).array().isNaN().all(), missing) << i;
    if (missing) continue;
    EXPECT_EQ(p.mean.row(i), clean.mean.row(i)) << i;
    EXPECT_EQ(p.variance.row(i), clean.variance.row(i)) << i;
  }
}

TEST(Posterior, FarFromTheDataIsThePrior) {
  const Posterior posterior = make(30, 2);
  Matrix F(4, 2);
  F << 1e6, 0, 1e308, -1e308, kInf, 0, -kInf, kInf;
  const Prediction p = predict(posterior, F);
  for (Index i = 0; i < 4; ++i) {
    EXPECT_EQ(p.mean.row(i), Matrix(Matrix::Zero(1, 3)));
    for (Index e = 0; e < 3; ++e)
      EXPECT_DOUBLE_EQ(p.variance(i, e), posterior.hyperparameters()[static_cast<std::size_t>(e)].signal_variance());
  }
}

TEST(Posterior, DegenerateTrainingDataNeverGiveNaN) {
  Matrix X = naive::normals(40, 3, 13);
  X.col(1).setConstant(2);
  X.bottomRows(20) = X.topRows(20);
  Matrix huge = X;
  huge.row(5) *= 1e250;
  const Matrix F = (Matrix(60, 3) << X.topRows(20), 1e3 * X.topRows(20), naive::normals(20, 3, 14)).finished();
  for (const Matrix& data : {X, huge, Matrix(Matrix::Zero(40, 3)), Matrix(X.topRows(1))}) {
    for (const double noise : {0.1, 1e-8, 1e-150}) {
      const Matrix Y = Matrix::Zero(data.rows(), 1);
      const Hyperparameters theta = naive::hyperparameters(3, 1, 1, noise);
      for (const double tolerance : {0.0, 0.01, 1.0}) {
        const Prediction p = predict(Posterior(Inputs(data), Y, {theta}, tolerance), F);
        EXPECT_TRUE(p.mean.allFinite());
        EXPECT_TRUE(p.variance.allFinite());
        EXPECT_GE(p.variance.minCoeff(), 0);
        EXPECT_LE(p.variance.maxCoeff(), 1);
      }
    }
  }
}

/// Targets of a smooth function with little noise: the weights are large, and cancel.
TEST(Posterior, KeepsToItsToleranceWhereThereIsHardlyNoise) {
  int summed_up = 0;
  for (std::uint64_t k = 250; k < 450; ++k) {
    Rng rng({.seed = k, .purpose = Purpose::test});
    const Index n = 60 + static_cast<Index>(k % 60);
    const Matrix X = naive::normals(n, 1, 100 + k);
    const double noise = std::pow(10, rng.uniform(-3.6, -3)), tolerance = 0.01;
    const Hyperparameters theta = naive::hyperparameters(1, std::exp(rng.uniform(-1.5, 3)), 1, noise);
    const double slope = rng.normal();
    Matrix y = (2 * slope * X).array().sin().matrix() + noise * naive::normals(n, 1, 500 + k);
    const Inputs inputs(X);
    const Posterior exact(inputs, y, {theta}), few(inputs, y, {theta}, tolerance);
    summed_up += few.mean_points(0) < n;
    const Matrix F = naive::normals(100, 1, 900 + k);
    const Prediction p = predict(exact, F), q = predict(few, F);
    EXPECT_LT((p.mean - q.mean).cwiseAbs().maxCoeff(), tolerance * noise * (1 + q.variance.maxCoeff())) << k;
  }
  EXPECT_GT(summed_up, 0);
}

TEST(Posterior, WritesIntoBlocks) {
  const Posterior posterior = make(10, 2);
  const Matrix F = naive::normals(12, 4, 15);
  Matrix mean = Matrix::Zero(20, 5), variance = mean;
  posterior.predict(F.rightCols(2), mean.block(3, 1, 12, 3), variance.block(3, 2, 12, 3));
  const Prediction p = predict(posterior, F.rightCols(2));
  EXPECT_EQ(mean.block(3, 1, 12, 3), p.mean);
  EXPECT_EQ(variance.block(3, 2, 12, 3), p.variance);
  EXPECT_TRUE(mean.col(0).isZero() && mean.topRows(3).isZero() && mean.bottomRows(5).isZero());
}

TEST(Posterior, WrongInputIsNamed) {
  const Inputs inputs(naive::normals(10, 2, 16));
  EXPECT_THROW(Posterior(inputs, Matrix::Zero(9, 1), {naive::hyperparameters(2, 1, 1, 1)}), InvalidInput);
  EXPECT_THROW(Posterior(inputs, Matrix::Zero(10, 2), {naive::hyperparameters(2, 1, 1, 1)}), InvalidInput);
  EXPECT_THROW(Posterior(inputs, Matrix::Zero(10, 1), {naive::hyperparameters(3, 1, 1, 1)}), InvalidInput);
  EXPECT_THROW(Posterior(inputs, Matrix::Zero(10, 1), {naive::hyperparameters(2, 1, 1e-200, 1e200)}), InvalidInput);
}

}  // namespace
}  // namespace rehearse::gp
