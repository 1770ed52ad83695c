#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "rehearse/dynamics/measured_path.hpp"

namespace rehearse::dynamics {

/// The residuals of a block's rows, output by output: r = g + w + B v, with v the errors of its measurements, state by
/// state (smoothing.hpp).
struct ErrorsInVariables {
  std::vector<Matrix> K;          // covariances of g, one an output: rows × rows
  Eigen::SparseMatrix<double> B;  // dx rows × dx measurements

  /// Of B v, where v has variances R (dx).
  Matrix covariance_of_errors(const Vector& R) const;

  /// Of r, where w has variances W (dx).
  Matrix covariance(const Vector& R, const Vector& W) const;
};

/// B: `before` and `after` are what an error of each state (dx) adds to the residuals of all rows (n × dx) through the
/// measurement before and after.
Eigen::SparseMatrix<double> errors_of(const Block& block, const std::vector<Matrix>& before,
                                      const std::vector<Matrix>& after);

/// Each number of `values` n times.
Vector repeated(const Vector& values, Index n);

}  // namespace rehearse::dynamics
