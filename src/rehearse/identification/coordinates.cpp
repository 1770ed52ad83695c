#include "rehearse/identification/coordinates.hpp"

#include <algorithm>

namespace rehearse::identification {
namespace {

constexpr double kDifferences[] = {1e-5, 0.02};  // of a box; the larger where the smaller moves nothing
constexpr double kPreciseStep = 1e-3;            // between five points

Matrix slope(const std::function<Matrix(const Vector&)>& of, const Vector& z, const Matrix& at, Index i) {
  const double inwards = z(i) < 0.5 ? 1 : -1;
  for (const double size : kDifferences) {
    for (const double direction : {inwards, -inwards}) {
      Vector other = z;
      other(i) = std::clamp(z(i) + direction * size, 0.0, 1.0);
      const Matrix difference = of(other) - at;
      if (difference.allFinite() && !difference.isZero(0)) return difference / (other(i) - z(i));
    }
  }
  return Matrix::Zero(at.rows(), at.cols());
}

}  // namespace

Coordinates::Coordinates(const ParameterSpace& space, Vector phi)
    : phi_(std::move(phi)), continuous_(space.of_kind(Parameter::Kind::continuous)) {
  low_.resize(static_cast<Index>(continuous_.size()));
  high_.resize(low_.size());
  for (Index i = 0; i < low_.size(); ++i) {
    const Interval box = space[continuous_[static_cast<std::size_t>(i)]].box;
    low_(i) = box.low;
    high_(i) = box.high;
  }
  width_ = high_ - low_;
}

Vector Coordinates::start() const { return ((phi_(continuous_) - low_).array() / width_.array()).max(0).min(1); }

Vector Coordinates::phi(const Vector& z) const {
  Vector phi = phi_;
  phi(continuous_) = (low_ + z.cwiseProduct(width_)).cwiseMin(high_);  // rounding may lead beyond
  return phi;
}

std::vector<Matrix> slopes(const std::function<Matrix(const Vector&)>& of, const Vector& z, const Matrix& at) {
  std::vector<Matrix> all;
  for (Index i = 0; i < z.size(); ++i) all.push_back(slope(of, z, at, i));
  return all;
}

PreciseSlopes precise_slopes(const std::function<Matrix(const Vector&)>& of, const Vector& z, const Matrix& at) {
  PreciseSlopes result;
  for (Index i = 0; i < z.size(); ++i) {
    const double step = z(i) < 0.5 ? kPreciseStep : -kPreciseStep;
    const auto difference = [&](int steps) -> Matrix { return of(z + steps * step * Vector::Unit(z.size(), i)) - at; };
    const Matrix d2 = difference(2), d4 = difference(4);
    Matrix slope = (48 * difference(1) - 36 * d2 + 16 * difference(3) - 3 * d4) / (12 * step);
    Matrix wider = (48 * d2 - 36 * d4 + 16 * difference(6) - 3 * difference(8)) / (24 * step);
    if (!slope.allFinite() || !wider.allFinite() || slope.isZero(0))
      slope = wider = identification::slope(of, z, at, i);
    result.errors.push_back(wider - slope);
    result.values.push_back(std::move(slope));
  }
  return result;
}

}  // namespace rehearse::identification
