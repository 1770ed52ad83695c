#include "rehearse/gp/evidence.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "naive.hpp"
#include "rehearse/core/test/reference.hpp"
#include "rehearse/testing/check_gradient.hpp"

namespace rehearse::gp {
namespace {

TEST(Evidence, AgreesWithPilco) {
  const auto reference = reference::load("a_gp_nlml.json");
  const Inputs inputs(reference::matrix(reference["inputs"]["X"]));
  const Matrix Y = reference::matrix(reference["inputs"]["Y"]);
  const Penalties penalties{.length = true, .length_limit = 100, .snr = true, .snr_limit = 1000};
  Workspace workspace;
  for (const auto& point : reference["outputs"]["evaluations"]) {
    const Matrix flat = reference::matrix(point["loghyp"]), slopes = reference::matrix(point["dnlml"]),
                 penalised_slopes = reference::matrix(point["hypcurb_df"]);
    for (Index e = 0; e < Y.cols(); ++e) {
      Vector gradient;
      const double value = evidence(inputs, Y.col(e), flat.col(e), workspace, &gradient).value;
      const double expected = -point["nlml"][static_cast<std::size_t>(e)].get<double>();
      const double penalised = -point["hypcurb_f"][static_cast<std::size_t>(e)].get<double>();
      EXPECT_NEAR(value, expected, 1e-8 * std::abs(expected)) << point["point"] << e;
      EXPECT_LT((gradient + slopes.col(e)).lpNorm<Eigen::Infinity>(), 1e-8 * slopes.cwiseAbs().maxCoeff());
      const double wall = penalty(inputs, flat.col(e), penalties, &gradient);
      EXPECT_NEAR(value + wall, penalised, 1e-8 * std::abs(penalised)) << point["point"] << e;
      EXPECT_LT((gradient + penalised_slopes.col(e)).lpNorm<Eigen::Infinity>(),
                1e-8 * penalised_slopes.cwiseAbs().maxCoeff());
    }
  }
}

TEST(Evidence, AgreesWithTheBook) {
  Workspace workspace;  // one for all sizes
  for (const Index n : {1, 2, 17, 64, 150, 9}) {
    for (const Index D : {1, 4, 7}) {
      const Matrix X = 3 * naive::normals(n, D, 1).array() + 10;
      const Hyperparameters theta = naive::hyperparameters(D, 2, 5, 0.3);
      const Vector y = naive::draw(X, theta, 2);
      const double value = evidence(Inputs(X), y, theta.flat(), workspace).value;
      const double expected = naive::evidence(X, y, theta);
      EXPECT_NEAR(value, expected, 1e-10 * (std::abs(expected) + 1)) << n << " " << D;
    }
  }
}

TEST(Evidence, WithATrendAgreesWithTheBook) {
  Workspace workspace;
  for (const Index n : {1, 17, 64, 75}) {
    for (const Index D : {1, 5}) {
      const Matrix X = 2 * naive::normals(n, D, 1).array() + 1;
      const Hyperparameters theta = naive::with_trend(naive::hyperparameters(D, 2, 1, 0.3), 0.7);
      const Vector y = naive::draw(X, theta, 2);
      const double expected = naive::evidence(X, y, theta);
      EXPECT_NEAR(evidence(Inputs(X), y, theta.flat(), workspace).value, expected, 1e-8 * (std::abs(expected) + 1))
          << n << " " << D;
      const Hyperparameters none = naive::hyperparameters(D, 2, 1, 0.3);
      EXPECT_NEAR(evidence(Inputs(X), y, none.flat(), workspace).value, naive::evidence(X, y, none),
                  1e-10 * (std::abs(naive::evidence(X, y, none)) + 1))
          << "with the same workspace";
    }
  }
}

TEST(Evidence, AddsKnownNoise) {
  const Matrix X = naive::normals(40, 3, 1), A = naive::normals(40, 40, 2);
  const Hyperparameters theta = naive::with_trend(naive::hyperparameters(3, 2, 1.5, 0.3), 0.5);
  const Vector y = naive::draw(X, theta, 2);
  const Matrix errors = 0.01 * A * A.transpose();
  const Eigen::LLT<Matrix> llt(naive::noisy_covariance(X, theta) + errors);
  const double expected =
      -0.5 * y.dot(llt.solve(y)) - llt.matrixLLT().diagonal().array().log().sum() - 20 * std::log(2 * M_PI);
  const Inputs inputs(X);
  const KnownNoise noise(errors);
  Workspace workspace;
  const auto value = [&](const Vector& flat, Vector& gradient) {
    return evidence(inputs, y, flat, workspace, &gradient, &noise).value;
  };
  EXPECT_NEAR(evidence(inputs, y, theta.flat(), workspace, nullptr, &noise).value, expected, 1e-8);
  EXPECT_EQ(testing::check_gradient(value, theta.flat(), 1e-7), std::vector<std::string>{});
}

/// The evidence and penalties of these data.
optim::Differentiable penalised(const Inputs& inputs, const Vector& y, const Penalties& penalties) {
  return [&inputs, y, penalties, workspace = std::make_shared<Workspace>()](const Vector& flat, Vector& gradient) {
    const double value = evidence(inputs, y, flat, *workspace, &gradient).value;
    return value + penalty(inputs, flat, penalties, &gradient);
  };
}

TEST(Evidence, GradientAgreesWithFiniteDifferences) {
  const Penalties penalties{
      .length = true, .length_limit = 3, .snr = true, .snr_limit = 20, .length_deviation = 0.7, .length_median = 2};
  for (const Index n : {1, 12, 75}) {
    const Matrix X = naive::normals(n, 6, 3);
    const Hyperparameters theta = naive::hyperparameters(6, 1.5, 2, 0.2);
    const Vector y = naive::draw(X, theta, 4);
    const Inputs inputs(X);
    for (const Hyperparameters& at : {theta, naive::with_trend(theta, 0.6)})
      EXPECT_EQ(testing::check_gradient(penalised(inputs, y, penalties), at.flat(), 1e-7), std::vector<std::string>{})
          << n << (at.has_trend() ? " with a trend" : "");
  }
}

TEST(Penalty, OfLengthsIsALogNormalDensity) {
  const Inputs inputs(naive::normals(20, 2, 3));
  const Penalties penalties{.length_deviation = 0.5, .length_median = 4};
  Vector flat = Vector::Zero(4);
  flat.head(2) = (4 * inputs.spread()).array().log();
  EXPECT_NEAR(penalty(inputs, flat, penalties), 0, 1e-12) << "at the median";
  flat(0) += 0.5;
  flat(1) -= 1;
  EXPECT_NEAR(penalty(inputs, flat, penalties), -0.5 - 2, 1e-12) << "one and two deviations from it";
  EXPECT_EQ(penalty(inputs, flat, {}), 0);
}

TEST(Evidence, GradientIsUsableAtTheLargestSignalToNoiseRatio) {
  const Matrix X = naive::normals(300, 3, 5);
  Hyperparameters theta = naive::hyperparameters(3, 2, 1, 1e-5);  // the default max_snr of the fit
  const Vector y = (X.rowwise().sum().array()).sin();
  const Inputs inputs(X);
  Workspace workspace;
  EXPECT_EQ(evidence(inputs, y, theta.flat(), workspace).jitter, 0);
  EXPECT_EQ(testing::check_gradient(penalised(inputs, y, {}), theta.flat(), 1e-3), std::vector<std::string>{});
}

TEST(Whitening, GivesTheEvidenceOfAnyTargets) {
  for (const Index n : {1, 17, 100}) {
    const Matrix X = naive::normals(n, 3, 13);
    const Hyperparameters theta = naive::hyperparameters(3, 1.5, 4, 0.3);
    const Whitening whiten(Inputs(X), theta);
    const Matrix Y = naive::normals(n, 3, 14), whitened = whiten(Y);
    for (Index k = 0; k < 3; ++k) {
      EXPECT_EQ(whiten(Y.col(k)), whitened.col(k)) << "one by one as together";
      EXPECT_NEAR(whiten.log_evidence(whitened.col(k)), naive::evidence(X, Y.col(k), theta), 1e-9);
    }
  }
  Hyperparameters impossible = naive::hyperparameters(3, 1, 1, 0.1);
  impossible.log_lengths(1) = kNaN;
  EXPECT_TRUE(std::isnan(Whitening(Inputs(naive::normals(5, 3, 15)), impossible).log_evidence(Vector::Zero(5))));
}

TEST(Evidence, DoesNotDependOnTheUnits) {
  const Matrix X = naive::normals(40, 2, 6);
  const Hyperparameters theta = naive::hyperparameters(2, 1, 1, 0.1);
  const Vector y = naive::draw(X, theta, 7);
  Hyperparameters tiny = theta;
  tiny.log_lengths.array() += std::log(1e100);
  tiny.log_signal += std::log(1e-14), tiny.log_noise += std::log(1e-14);
  Workspace workspace;
  const double value = evidence(Inputs(X), y, theta.flat(), workspace).value;
  const double other = evidence(Inputs(1e100 * X), 1e-14 * y, tiny.flat(), workspace).value;
  EXPECT_NEAR(other - 40 * std::log(1e14), value, 1e-9);
}

TEST(Evidence, WhatCannotBeComputedIsNaNAndNothingCrashes) {
  const Inputs inputs(naive::normals(10, 2, 8));
  const Vector y = naive::normals(10, 1, 9);
  Workspace workspace;
  Vector gradient;
  for (const double bad : {kNaN, kInf, -kInf, 1e6, -1e6}) {
    for (Index k = 0; k < 4; ++k) {
      Vector flat = Vector::Zero(4);
      flat(k) = bad;
      const Evidence result = evidence(inputs, y, flat, workspace, &gradient);
      if (!result.ok()) {
        EXPECT_TRUE(std::isnan(result.value));
        EXPECT_TRUE(gradient.array().isNaN().all());
      }
    }
    Vector bad_y = y;
    bad_y(3) = bad;
    EXPECT_EQ(evidence(inputs, bad_y, Vector::Zero(4), workspace, &gradient).ok(), std::isfinite(bad));
  }
}

TEST(Evidence, DegenerateInputsAreFinite) {
  Matrix X = naive::normals(30, 3, 10);
  X.col(1).setConstant(4);
  X.bottomRows(10) = X.topRows(10);
  X.row(2) *= 1e150;
  const Inputs inputs(X);
  Workspace workspace;
  Vector gradient;
  for (const double noise : {1.0, 1e-3, 1e-12, 0.0}) {
    Vector flat = Vector::Zero(5);
    flat(4) = std::log(noise + 1e-300);
    const Evidence result = evidence(inputs, Vector::Zero(30), flat, workspace, &gradient);
    EXPECT_TRUE(result.ok()) << noise;
    EXPECT_TRUE(gradient.allFinite()) << noise;
    EXPECT_TRUE(std::isfinite(penalty(inputs, flat, {.length = true, .snr = true}, &gradient)));
    EXPECT_EQ(gradient(1), penalty(inputs, flat, {}) + gradient(1));
  }
}

}  // namespace
}  // namespace rehearse::gp
