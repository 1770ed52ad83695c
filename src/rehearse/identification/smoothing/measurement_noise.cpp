#include "rehearse/identification/smoothing/measurement_noise.hpp"

#include <algorithm>
#include <cmath>

#include "rehearse/identification/smoothing/transition_slopes.hpp"

namespace rehearse::identification {
namespace {

constexpr Index kMostRows = 64;
constexpr int kMostSweeps = 10000;
constexpr double kConverged = 1e-10;

/// dx × dx: the mean square of what a measurement's error in state d adds to change e through the state before.
Matrix mean_square_slopes(const dynamics::DynamicsModel& model, const Dataset& data) {
  const Index dx = data.states.cols(), stride = (data.size() + kMostRows - 1) / kMostRows;
  const auto some = Eigen::seq(0, data.size() - 1, stride);
  const std::vector<Matrix> slopes =
      transition_slopes(model, {.states = data.states(some, Eigen::all), .actions = data.actions(some, Eigen::all)});
  Matrix squares = Matrix::Zero(dx, dx);
  for (Index d = 0; d < dx; ++d) {
    const Matrix& of_d = slopes[static_cast<std::size_t>(d)];
    Index rows = 0;
    for (Index i = 0; i < of_d.rows(); ++i) {
      if (!of_d.row(i).allFinite()) continue;
      squares.col(d) += of_d.row(i).cwiseAbs2().transpose();
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
    if (farthest < kConverged) break;
  }
  return x;
}

}  // namespace

Vector measurement_std(const dynamics::DynamicsModel& model, const Dataset& data, const Vector& noise_variances) {
  Matrix shares = mean_square_slopes(model, data);
  shares.diagonal().array() += 1;
  // The system in units of each state's own noise, whose sizes differ by many digits.
  shares = noise_variances.cwiseInverse().asDiagonal() * shares * noise_variances.asDiagonal();
  return noise_variances.cwiseProduct(non_negative_least_squares(shares)).cwiseSqrt();
}

}  // namespace rehearse::identification
