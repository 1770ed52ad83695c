#include "rehearse/identification/sigma_points.hpp"

#include <gtest/gtest.h>

namespace rehearse::identification {
namespace {

const ParameterSpace kSpace({Parameter::continuous("m", 1, {0.5, 2}), Parameter::fixed("g", 9.81),
                             Parameter::continuous("l", 0.5, {0.1, 1})});
const Vector kPhi{{1.2, 9.81, 0.6}};

PhiPosterior posterior(const Matrix& covariance) {
  return {.parameters = {kSpace[0], kSpace[2]}, .mean = Vector{{1.2, 0.6}}, .covariance = covariance};
}

TEST(SigmaPoints, HaveTheMeanAndTheCovarianceOfThePosterior) {
  const Matrix covariance{{0.01, -0.004}, {-0.004, 0.0025}};
  const auto points = sigma_points(posterior(covariance), kSpace, kPhi);
  ASSERT_EQ(points.size(), 4u);
  Vector mean = Vector::Zero(3);
  for (const Vector& point : points) mean += point / 4;
  EXPECT_TRUE(mean.isApprox(kPhi, 1e-12)) << mean.transpose();
  Matrix spread = Matrix::Zero(2, 2);
  for (const Vector& point : points) {
    const Vector away{{point(0) - kPhi(0), point(2) - kPhi(2)}};
    spread += away * away.transpose() / 4;
    EXPECT_EQ(point(1), 9.81) << "not a parameter of the posterior";
  }
  EXPECT_TRUE(spread.isApprox(covariance, 1e-12)) << spread;
}

TEST(SigmaPoints, StayInTheBox) {
  for (const Vector& point : sigma_points(posterior(Matrix{{4, 0}, {0, 1}}), kSpace, kPhi)) {
    EXPECT_GE(point(0), 0.5);
    EXPECT_LE(point(0), 2);
    EXPECT_GE(point(2), 0.1);
    EXPECT_LE(point(2), 1);
  }
}

}  // namespace
}  // namespace rehearse::identification
