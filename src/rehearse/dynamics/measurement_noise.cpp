#include "rehearse/dynamics/measurement_noise.hpp"

#include <algorithm>
#include <cmath>

#include "rehearse/gp/inputs.hpp"

namespace rehearse::dynamics {
namespace {

constexpr Index kMostRows = 64;
constexpr double kStep = 1e-3;  // of a state's spread over the data
constexpr int kMostSweeps = 10000;
constexpr double kStill = 1e-10;

Matrix predict(const DynamicsModel& model, const Matrix& X, const Matrix& U) {
  Matrix mean(X.rows(), X.cols());
  model.predict_mean(X, U, mean);
  return mean;
}

/// dx × dx: the mean square of what a measurement's error in state d adds to change e through the state before.
Matrix mean_square_slopes(const DynamicsModel& model, const Dataset& data) {
  const Index dx = data.states.cols(), stride = (data.size() + kMostRows - 1) / kMostRows;
  const Matrix X = data.states(Eigen::seq(0, data.size() - 1, stride), Eigen::all);
  const Matrix U = data.actions(Eigen::seq(0, data.size() - 1, stride), Eigen::all);
  Matrix squares = Matrix::Zero(dx, dx);
  for (Index d = 0; d < dx; ++d) {
    const double step = kStep * gp::standard_deviation(data.states.col(d));
    if (!(step > 0)) continue;
    Matrix up = X, down = X;
    up.col(d).array() += step;
    down.col(d).array() -= step;
    Matrix slopes = (predict(model, up, U) - predict(model, down, U)) / (2 * step);
    slopes.col(d).array() += 1;
    Index rows = 0;
    for (Index i = 0; i < slopes.rows(); ++i) {
      if (!slopes.row(i).allFinite()) continue;
      squares.col(d) += slopes.row(i).cwiseAbs2().transpose();
      ++rows;
    }
    squares.col(d) /= static_cast<double>(std::max<Index>(rows, 1));
  }
  return squares;
}

/// The x ≥ 0 that minimises ‖A x − 1‖², by turns over its numbers; the columns of A are positive.
Vector non_negative_least_squares(const Matrix& A) {
  Vector x = Vector::Zero(A.cols()), residual = Vector::Ones(A.rows());
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double farthest = 0;
    for (Index d = 0; d < A.cols(); ++d) {
      const double moved = std::max(0.0, x(d) + A.col(d).dot(residual) / A.col(d).squaredNorm());
      residual -= (moved - x(d)) * A.col(d);
      farthest = std::max(farthest, std::abs(moved - x(d)));
      x(d) = moved;
    }
    if (farthest < kStill) break;
  }
  return x;
}

}  // namespace

Vector measurement_std(const DynamicsModel& model, const Dataset& data, const Vector& noise_variances) {
  Matrix shares = mean_square_slopes(model, data);
  shares.diagonal().array() += 1;
  // In units of each state's own noise, whose sizes differ by many digits.
  shares = noise_variances.cwiseInverse().asDiagonal() * shares * noise_variances.asDiagonal();
  return noise_variances.cwiseProduct(non_negative_least_squares(shares)).cwiseSqrt();
}

}  // namespace rehearse::dynamics
