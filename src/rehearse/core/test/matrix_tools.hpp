#pragma once

#include "rehearse/core/random.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse {

inline Matrix normals(Index rows, Index columns, std::uint64_t seed) {
  Rng rng({.seed = seed});
  Matrix X(rows, columns);
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i) X(i, j) = rng.normal();
  return X;
}

inline Matrix positive_definite(Index n) {
  const Matrix A = normals(n, n, 1);
  return A * A.transpose() / static_cast<double>(n) + 0.1 * Matrix::Identity(n, n);
}

}  // namespace rehearse
