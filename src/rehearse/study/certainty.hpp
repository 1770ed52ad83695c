#pragma once

#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::study {

/// A least-squares fit at its minimum; coordinates are fractions of boxes.
struct FittedSquares {
  Vector errors;              // N, of a usual size of 1
  Matrix derivatives;         // N × coordinates
  std::vector<Index> blocks;  // N: errors of different blocks are independent
};

/// The variance of the sums over blocks relative to that of independent errors (Liang 1986): of all directions
/// together, and four times that, since blocks are few and friction is not the same in each log.
double inflation(const FittedSquares& fitted);

/// The covariance of all coordinates that errors of which neighbours are alike leave: the precision is JᵀJ / inflation,
/// and that of the boxes.
Matrix covariance(const FittedSquares& fitted);

}  // namespace rehearse::study
