#include "rehearse/identification/smoothing/measurement_noise.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/test/swing.hpp"
#include "rehearse/identification/learn.hpp"

namespace rehearse::identification {
namespace {

/// Changes X A'.
class Linear final : public dynamics::DynamicsModel {
 public:
  explicit Linear(Matrix A) : A_(std::move(A)) {}
  void predict(const ConstMatrixView& X, const ConstMatrixView&, MatrixView mean, MatrixView variance) const override {
    mean = X * A_.transpose();
    variance.setZero();
  }

 private:
  Matrix A_;
};

Dataset rows(Index n, Index dx) {
  Rng rng({.purpose = Purpose::test});
  Dataset data{.states = Matrix(n, dx), .actions = Matrix::Zero(n, 1), .changes = Matrix::Zero(n, dx)};
  for (double& x : data.states.reshaped()) x = rng.normal();
  return data;
}

/// The noise of a linear model's outputs where states are measured with these variances.
Vector noise_of(const Matrix& A, const Vector& variances) {
  const Matrix through = A + Matrix::Identity(A.rows(), A.cols());
  return variances + through.cwiseAbs2() * variances;
}

TEST(MeasurementStd, SolvesForWhatMeasurementsAdd) {
  const Matrix A{{-0.2, 2, 0.5}, {0.1, 0.3, 0}, {0, -3, -1}};
  for (const Vector& variances : {Vector{{1e-4, 1e-4, 1e-4}}, Vector{{1e-3, 1e-5, 4e-4}}, Vector{{0, 1e-4, 1e-3}}}) {
    const Vector std = measurement_std(Linear(A), rows(500, 3), noise_of(A, variances));
    EXPECT_LT((std - variances.cwiseSqrt()).cwiseAbs().maxCoeff(), 1e-3 * variances.cwiseSqrt().maxCoeff());
  }
  const Vector impossible{{1e-8, 1e-4, 1e-8}};  // the second state's noise would be in the others' too
  const Vector std = measurement_std(Linear(A), rows(500, 3), impossible);
  EXPECT_GE(std.minCoeff(), 0);
  EXPECT_LT(std(1), 0.005);
}

/// Steps of the swing, measured with noise of these deviations.
Dataset measured_swing(Index rows, const Vector& std) {
  Rng rng({.purpose = Purpose::test});
  Dataset data = swing::data(rows, 1);
  for (Index i = 0; i < data.size(); ++i)
    for (Index d = 0; d < 2; ++d) {
      const double before = std(d) * rng.normal(), after = std(d) * rng.normal();
      data.states(i, d) += before;
      data.changes(i, d) += after - before;
    }
  return data;
}

TEST(MeasurementStd, OfLearnedModelsIsAboutTheTrueOne) {
  const Vector std{{0.05, 0.02}};
  const Dataset data = measured_swing(200, std);
  const prior::Prior prior = swing::prior_at(swing::kTruth);
  const Learned learned = learn({data, swing::features(), {}, &prior}, FixedPrior{}, {}, serial_evaluator());
  const Vector found = learned.model->measurement_std();
  for (Index d = 0; d < 2; ++d) EXPECT_NEAR(found(d) / std(d), 1, 0.25) << d;
}

TEST(MeasurementStd, CountsTheNoiseOfRatesInPositionsThatFollowFromThem) {
  const Dataset data = measured_swing(300, Vector{{0.2, 0.005}});  // of the rate most
  const Learned learned =
      learn({data, swing::features(), swing::kinematics(), nullptr}, ZeroMean{}, {}, serial_evaluator());
  EXPECT_NEAR(learned.model->measurement_std()(0) / 0.2, 1, 0.25);
}

}  // namespace
}  // namespace rehearse::identification
