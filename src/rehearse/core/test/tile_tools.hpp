#pragma once

#include <vector>

#include "rehearse/core/tiles.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse {

inline Matrix lower(const Matrix& A) { return A.triangularView<Eigen::Lower>(); }

inline Matrix lower_from_tiles(Index n, const std::vector<double>& tiles) {
  Matrix A = Matrix::Zero(n, n);
  for (Index j = 0; j < n; ++j)
    for (Index i = j; i < n; ++i) A(i, j) = tiles[static_cast<std::size_t>(entry_offset(i, j))];
  return A;
}

/// The lower triangle; the rest of the tiles is 0.
inline std::vector<double> to_tiles(const Matrix& A) {
  std::vector<double> tiles(static_cast<std::size_t>(tiles_size(A.rows())));
  for (Index j = 0; j < A.rows(); ++j)
    for (Index i = j; i < A.rows(); ++i) tiles[static_cast<std::size_t>(entry_offset(i, j))] = A(i, j);
  return tiles;
}

}  // namespace rehearse
