#pragma once

#include <gtest/gtest.h>

#include "rehearse/policy/differentiable.hpp"

namespace rehearse::policy {

/// Derivatives of a weighted sum of the actions of all rows against central differences.
inline void check_slopes(const Policy& policy, const Vector& theta, const Matrix& X, const Matrix& weights) {
  const auto* differentiable = dynamic_cast<const Differentiable*>(&policy);
  ASSERT_NE(differentiable, nullptr);
  const auto values = [&](const Vector& at_theta, const Matrix& at_x) {
    Matrix U(X.rows(), policy.actions());
    policy.act(at_theta.transpose().replicate(X.rows(), 1), at_x, 0, U);
    return Vector(U.cwiseProduct(weights).rowwise().sum());
  };
  Matrix by_states = Matrix::Constant(X.rows(), X.cols(), kNaN);
  Vector by_theta = Vector::Constant(theta.size(), 3);
  differentiable->pull_back(theta, X, weights, by_states, by_theta);
  const double h = 1e-5;
  for (Index s = 0; s < X.cols(); ++s) {
    Matrix more = X, less = X;
    more.col(s).array() += h;
    less.col(s).array() -= h;
    const Vector slope = (values(theta, more) - values(theta, less)) / (2 * h);
    EXPECT_LT((by_states.col(s) - slope).norm(), 1e-6 * (1 + slope.norm())) << "state " << s;
  }
  for (Index i = 0; i < theta.size(); ++i) {
    Vector more = theta, less = theta;
    more(i) += h;
    less(i) -= h;
    const double slope = (values(more, X) - values(less, X)).sum() / (2 * h);
    EXPECT_NEAR(by_theta(i) - 3, slope, 1e-6 * (1 + std::abs(slope))) << "theta " << i;
  }
}

}  // namespace rehearse::policy
