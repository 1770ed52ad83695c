#pragma once

#include <cstring>

#include "rehearse/core/types.hpp"

namespace rehearse::testing {

/// True if two doubles have the same bits; all NaNs count as equal.
inline bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b); }

/// The same for all entries of two matrices of the same size.
inline bool same(const ConstMatrixView& A, const ConstMatrixView& B) {
  if (A.rows() != B.rows() || A.cols() != B.cols()) return false;
  for (Index c = 0; c < A.cols(); ++c)
    for (Index r = 0; r < A.rows(); ++r)
      if (!same(A(r, c), B(r, c))) return false;
  return true;
}

}  // namespace rehearse::testing
