#include "rehearse/optim/spread.hpp"

#include <cmath>

namespace rehearse::optim {

Vector spread_point(Index dimensions, Index i) {
  double ratio = 2;  // the root of ratio^(dimensions + 1) = ratio + 1
  for (int k = 0; k < 60; ++k) ratio = std::pow(1 + ratio, 1 / static_cast<double>(dimensions + 1));
  Vector point(dimensions);
  for (Index d = 0; d < dimensions; ++d) {
    const double t = 0.5 + static_cast<double>(i) * std::pow(ratio, -static_cast<double>(d + 1));
    point(d) = t - std::floor(t);
  }
  return point;
}

}  // namespace rehearse::optim
