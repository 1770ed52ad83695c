#include "rehearse/statistics/root_mean_squares.hpp"

#include <cmath>

namespace rehearse::statistics {

Vector root_mean_squares(const Matrix& columns) {
  Vector result(columns.cols());
  for (Index c = 0; c < columns.cols(); ++c) {
    double n = 0, squares = 0;
    for (const double value : columns.col(c))
      if (std::isfinite(value)) n += 1, squares += value * value;
    result(c) = std::sqrt(squares / n);
  }
  return result;
}

}  // namespace rehearse::statistics
