#include "rehearse/identification/smoothing/errors_in_variables.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse::identification {
namespace {

// Two states that stay, measured with errors: rows 0 and 1 follow each other, row 2 is on its own.
struct Steps {
  Steps() {
    data.states = Matrix(3, 2);
    data.states << 0, 0, 1, 2, 9, 9;
    data.actions = Matrix::Zero(3, 1);
    data.changes = Matrix(3, 2);
    data.changes << 1, 2, 1, 1, 1, 1;
    Rng rng({.purpose = Purpose::test});
    for (std::vector<Matrix>* slopes : {&before, &after})
      for (Matrix& slope : *slopes) {
        slope = Matrix(3, 2);
        for (double& s : slope.reshaped()) s = rng.normal();
      }
  }
  ErrorsInVariables errors(Measurements measurements = Measurements::shared) const {
    ErrorsInVariables errors(data, serial_evaluator(), measurements);
    errors.set_variances(R);
    errors.linearise(before, after, [&](Index e, Index, Index) { return K[static_cast<std::size_t>(e)]; });
    EXPECT_TRUE(errors.factorise(W));
    return errors;
  }

  /// The residuals (n × dx) that errors of five measurements make.
  Matrix made_of(const Matrix& v) const {
    Matrix r = Matrix::Zero(3, 2);
    const Index from[] = {0, 1, 3};
    for (Index row = 0; row < 3; ++row)
      for (Index d = 0; d < 2; ++d)
        r.row(row) += v(from[row], d) * before[static_cast<std::size_t>(d)].row(row) +
                      v(from[row] + 1, d) * after[static_cast<std::size_t>(d)].row(row);
    return r;
  }

  /// The covariance of the residuals, output by output.
  Matrix covariance(bool errors_alone = false) const {
    Matrix C = Matrix::Zero(6, 6);
    for (Index m = 0; m < 5; ++m)
      for (Index d = 0; d < 2; ++d) {
        const Matrix r = made_of(Matrix::NullaryExpr(5, 2, [&](Index i, Index j) { return i == m && j == d; }));
        C += R(d) * r.reshaped() * r.reshaped().transpose();
      }
    if (errors_alone) return C;
    for (Index e = 0; e < 2; ++e)
      C.block(3 * e, 3 * e, 3, 3) += K[static_cast<std::size_t>(e)] + W(e) * Matrix::Identity(3, 3);
    return C;
  }

  Dataset data;
  std::vector<Matrix> before{2}, after{2};
  const std::vector<Matrix> K{Matrix::Identity(3, 3), 2 * Matrix::Ones(3, 3)};
  const Vector R{{0.5, 2}}, W{{0.1, 0.3}};
};

const Vector kResiduals{{0.3, -1, 2, 0.5, 0.7, -0.2}};

TEST(ErrorsInVariables, EvidenceIsThatOfANormalDistribution) {
  const Steps steps;
  const Matrix C = steps.covariance();
  const double expected =
      -0.5 * kResiduals.dot(C.inverse() * kResiduals) - 0.5 * std::log(C.determinant()) - 3 * std::log(2 * M_PI);
  const ErrorsInVariables errors = steps.errors();
  EXPECT_NEAR(errors.log_evidence(kResiduals), expected, 1e-10);
  EXPECT_NEAR(errors.whitened(kResiduals).squaredNorm(), kResiduals.dot(C.inverse() * kResiduals), 1e-10);
}

TEST(ErrorsInVariables, StepsWithErrorsOfTheirOwnHaveOnlyCovariancesWithinAStep) {
  const Steps steps;
  Matrix C = steps.covariance() - steps.covariance(true);
  const Matrix S = steps.covariance(true);
  for (Index i = 0; i < 6; ++i)
    for (Index j = 0; j < 6; ++j)
      if (i % 3 == j % 3) C(i, j) += S(i, j);
  const double expected =
      -0.5 * kResiduals.dot(C.inverse() * kResiduals) - 0.5 * std::log(C.determinant()) - 3 * std::log(2 * M_PI);
  EXPECT_NEAR(steps.errors(Measurements::own).log_evidence(kResiduals), expected, 1e-10);
}

TEST(ErrorsInVariables, OutputsAreGivenTheOthersAsInANormalDistribution) {
  const Steps steps;
  const Matrix C = steps.covariance(), S = steps.covariance(true);
  const auto given = steps.errors().given_others(kResiduals, steps.W);
  for (Index e = 0; e < 2; ++e) {
    const auto own = Eigen::seqN(3 * e, 3), other = Eigen::seqN(3 - 3 * e, 3);
    const Matrix gain = S(own, other) * C(other, other).inverse();
    EXPECT_LT((given.residuals.col(e) - (kResiduals(own) - gain * kResiduals(other))).norm(), 1e-10);
    const Matrix errors = S(own, own) - gain * S(other, own);
    EXPECT_LT((given.errors[static_cast<std::size_t>(e)] - errors).norm(), 1e-10);
  }
}

TEST(ErrorsInVariables, StepsOfTheVariancesMakeResidualsLikelier) {
  const Steps steps;
  ErrorsInVariables errors = steps.errors();
  double last = errors.log_evidence(kResiduals);
  for (int i = 0; i < 20; ++i) {
    errors.improve_variances(kResiduals, Vector::Constant(2, 1e-9));
    errors.factorise(steps.W);
    const double now = errors.log_evidence(kResiduals);
    EXPECT_GT(now, last - 1e-12);
    last = now;
  }
  EXPECT_GT(last, steps.errors().log_evidence(kResiduals) + 0.1);
}

TEST(ErrorsInVariables, MovesThePathByWhatIsExpectedOfTheErrors) {
  const Steps steps;
  ErrorsInVariables errors = steps.errors();
  const Vector r = errors.residuals(Matrix(kResiduals.reshaped(3, 2)));
  EXPECT_EQ(r, kResiduals);  // the path is what was measured
  errors.subtract_errors(r);
  const Vector weights = steps.covariance().inverse() * kResiduals;
  for (Index d = 0; d < 2; ++d) {  // of the measurement before row 2, which no other row shares
    const double v = steps.R(d) * (steps.before[static_cast<std::size_t>(d)](2, 0) * weights(2) +
                                   steps.before[static_cast<std::size_t>(d)](2, 1) * weights(5));
    EXPECT_NEAR(errors.states()(3, d), 9 - v, 1e-10);
  }
  errors.move_path();
  EXPECT_NEAR(errors.path().states(2, 0), errors.states()(3, 0), 1e-12);
  // Residuals on the new path are those of measurements again once the errors are added.
  const Matrix shift = (Matrix(5, 2) << 0, 0, 1, 2, 2, 3, 9, 9, 10, 10).finished() - errors.states();
  EXPECT_LT((errors.residuals(Matrix::Zero(3, 2)) - Vector(steps.made_of(shift).reshaped())).norm(), 1e-10);
}

TEST(ErrorsInVariables, SayWhereTheirCovarianceCannotBeFactorised) {
  ErrorsInVariables errors = Steps().errors();
  EXPECT_FALSE(errors.factorise(Vector::Constant(2, -1e6)));
}

}  // namespace
}  // namespace rehearse::identification
