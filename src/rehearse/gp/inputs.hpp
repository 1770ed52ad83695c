#pragma once

#include <cmath>

#include "rehearse/core/types.hpp"

namespace rehearse::gp {

/// The standard deviation of a sample (by n − 1); 0 for fewer than two values.
double standard_deviation(const ConstVectorView& x);

/// The training inputs that all outputs share. Kept centred and divided by each column's half-range, so that no
/// finite value, however large, overflows a squared distance. Immutable; any thread.
class Inputs {
 public:
  /// X: n × D, n ≥ 1. Throws InvalidInput if a value is not finite or there is no row.
  explicit Inputs(const ConstMatrixView& X);

  Index size() const { return unit_.rows(); }
  Index dimensions() const { return unit_.cols(); }

  /// Sample standard deviation (n − 1) of each column, D. A constant column has max(|its value|, 1) instead: no data
  /// tells its length scale, and a penalty or a start must still be finite.
  const Vector& spread() const { return spread_; }

  /// √(centre² + spread²) of each column, D: how far from 0 its values are.
  Vector magnitude() const {
    return center_.binaryExpr(spread_, [](double c, double s) { return std::hypot(c, s); });
  }

  /// X (n × D), but for rounding.
  Matrix values() const { return (unit_ * half_range_.asDiagonal()).rowwise() + center_.transpose(); }

  const Matrix& unit() const { return unit_; }              // n × D, (X − center) / half_range, in [−1, 1]
  const Vector& center() const { return center_; }          // D
  const Vector& half_range() const { return half_range_; }  // D, > 0

 private:
  Matrix unit_;
  Vector center_, half_range_, spread_;
};

}  // namespace rehearse::gp
