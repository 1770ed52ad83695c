#include "rehearse/study/certainty.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "rehearse/identification/coordinates.hpp"

namespace rehearse::study {
namespace {

constexpr double kFewBlocks =
    4;  // so that intervals of recordings of the same arm overlap (docs/results/double-pendulum.md)
constexpr double kUnknown = 1e-9;  // of the largest: a direction that the errors tell nothing of

}  // namespace

double inflation(const FittedSquares& fitted) {
  const Matrix H = fitted.derivatives.transpose() * fitted.derivatives;
  const Index blocks = fitted.blocks.empty() ? 0 : *std::ranges::max_element(fitted.blocks) + 1;
  Matrix sums = Matrix::Zero(H.rows(), blocks);
  for (Index i = 0; i < fitted.errors.size(); ++i)
    sums.col(fitted.blocks[static_cast<std::size_t>(i)]) += fitted.errors(i) * fitted.derivatives.row(i).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(H);
  const Vector& values = solver.eigenvalues();
  double ratio = 0, directions = 0;
  for (Index i = 0; i < values.size(); ++i) {
    if (values(i) <= kUnknown * values.maxCoeff()) continue;  // all of them, where H is 0
    ratio += (solver.eigenvectors().col(i).transpose() * sums).squaredNorm() / values(i);
    directions += 1;
  }
  const double one = fitted.errors.squaredNorm() / static_cast<double>(fitted.errors.size());
  return kFewBlocks * std::max(ratio / std::max(directions, 1.0), one);
}

Matrix covariance(const FittedSquares& fitted) {
  const Matrix H = fitted.derivatives.transpose() * fitted.derivatives, one = Matrix::Identity(H.rows(), H.cols());
  return (H / inflation(fitted) + identification::kBoxPrecision * one).llt().solve(one);
}

}  // namespace rehearse::study
