#pragma once
// The GP by the book, with Eigen and loops, and data to try it on.

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "rehearse/core/test/matrix_tools.hpp"
#include "rehearse/gp/hyperparameters.hpp"

namespace rehearse::gp::naive {

using rehearse::normals;

inline Hyperparameters hyperparameters(Index dimensions, double length, double signal, double noise) {
  return {.log_lengths = Vector::LinSpaced(dimensions, std::log(length), std::log(2 * length)),
          .log_signal = std::log(signal),
          .log_noise = std::log(noise)};
}

/// The same with a trend, of τ_0 and other τ_d from one to half of that.
inline Hyperparameters with_trend(Hyperparameters theta, double trend) {
  const Index D = theta.inputs();
  theta.log_trend.resize(D + 1);
  theta.log_trend << std::log(trend), Vector::LinSpaced(D, std::log(trend), std::log(trend / 2));
  return theta;
}

/// n × m covariances of the latent function.
inline Matrix covariance(const Matrix& A, const Matrix& B, const Hyperparameters& theta) {
  Matrix K(A.rows(), B.rows());
  const Eigen::ArrayXd lengths = theta.lengths();
  const Eigen::ArrayXd trend = (2 * theta.log_trend.array()).exp();
  for (Index i = 0; i < A.rows(); ++i) {
    for (Index j = 0; j < B.rows(); ++j) {
      const Eigen::ArrayXd difference = (A.row(i) - B.row(j)).transpose().array() / lengths;
      K(i, j) = theta.signal_variance() * std::exp(-0.5 * difference.square().sum());
      if (!theta.has_trend()) continue;
      const auto products = A.row(i).transpose().array() * B.row(j).transpose().array();
      K(i, j) += std::pow(trend(0) + (trend.tail(A.cols()) * products).sum(), 2);
    }
  }
  return K;
}

/// The same with lengths and a signal of 1.
inline Matrix correlations(const Matrix& A, const Matrix& B) {
  return covariance(A, B, {.log_lengths = Vector::Zero(A.cols()), .log_signal = 0, .log_noise = 0});
}

inline Matrix noisy_covariance(const Matrix& X, const Hyperparameters& theta) {
  return covariance(X, X, theta) + theta.noise_variance() * Matrix::Identity(X.rows(), X.rows());
}

inline double evidence(const Matrix& X, const Vector& y, const Hyperparameters& theta) {
  const Eigen::LLT<Matrix> llt(noisy_covariance(X, theta));
  const double half_log_determinant = llt.matrixLLT().diagonal().array().log().sum();
  return -0.5 * y.dot(llt.solve(y)) - half_log_determinant - 0.5 * static_cast<double>(y.size()) * std::log(2 * M_PI);
}

/// A draw from the GP itself, noise included.
inline Vector draw(const Matrix& X, const Hyperparameters& theta, std::uint64_t seed) {
  return noisy_covariance(X, theta).llt().matrixL() * Vector(normals(X.rows(), 1, seed));
}

}  // namespace rehearse::gp::naive
