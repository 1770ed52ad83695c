#pragma once
// The matrices of Rehearse. core's names live in namespace rehearse itself, those of another room in its own.

#include <limits>

#include <Eigen/Core>

namespace rehearse {

using Index = Eigen::Index;

/// Column-major: with one state per ROW, each state variable is contiguous over the batch and vectorises.
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// Views of blocks whose columns are contiguous (a Matrix, or some of its rows or columns). Assigning to one does not
/// change its size; Eigen checks that without NDEBUG alone.
using MatrixView = Eigen::Ref<Matrix, 0, Eigen::OuterStride<>>;
using ConstMatrixView = Eigen::Ref<const Matrix, 0, Eigen::OuterStride<>>;
using VectorView = Eigen::Ref<Vector>;
using ConstVectorView = Eigen::Ref<const Vector>;

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();

/// A closed interval.
struct Interval {
  double low = 0;
  double high = 0;
};

}  // namespace rehearse
