#pragma once

#include <functional>
#include <vector>

#include "rehearse/core/parameters.hpp"

namespace rehearse::identification {

/// The precision of a coordinate of which its box alone is known: a uniform distribution on [0, 1] has the variance
/// 1/12.
inline constexpr double kBoxPrecision = 12;

/// The continuous parameters of a φ as coordinates z in [0, 1], fractions of their boxes; the rest of φ stays.
class Coordinates {
 public:
  Coordinates(const ParameterSpace& space, Vector phi);

  Index size() const { return low_.size(); }
  Vector start() const;                                                 // z of φ
  Vector phi(const Vector& z) const;                                    // inside the boxes
  const std::vector<Index>& parameters() const { return continuous_; }  // of the space
  const Vector& low() const { return low_; }                            // of the boxes
  const Vector& widths() const { return width_; }

 private:
  Vector phi_;
  std::vector<Index> continuous_;
  Vector low_, high_, width_;
};

/// The derivatives with respect to z, one a coordinate, of a matrix that depends on z and is `at` there, by differences
/// inside the box. A coordinate that cannot be moved without failure, or moves nothing, has derivative 0.
std::vector<Matrix> slopes(const std::function<Matrix(const Vector& z)>& of, const Vector& z, const Matrix& at);

/// Derivatives to fourth order, from points towards the inside of the box; where these fail, as `slopes` has them.
struct PreciseSlopes {
  std::vector<Matrix> values;
  std::vector<Matrix> errors;  // what twice the distance between the points changes: where differences do not resolve
                               // the derivatives, as much as their errors
};
PreciseSlopes precise_slopes(const std::function<Matrix(const Vector& z)>& of, const Vector& z, const Matrix& at);

}  // namespace rehearse::identification
