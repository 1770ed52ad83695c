#pragma once

#include <optional>

#include <Eigen/Cholesky>

#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// The minimum of a quadratic in a box.
struct BoxMinimum {
  Vector x;                        // n
  Eigen::Array<bool, -1, 1> free;  // n, false: x is at a bound that the minimum would leave
  Eigen::LLT<Matrix> factor_free;  // of H restricted to the free entries; meaningless if there are none
};

/// Minimises ½ xᵀHx + gᵀx, low ≤ x ≤ high, by projected Newton steps from `start` (Tassa 2014, section III.B). For a
/// handful of variables: it allocates. H: symmetric; nullopt where it is not positive definite. Any thread.
std::optional<BoxMinimum> minimise_in_box(const Matrix& H, const Vector& g, const Vector& low, const Vector& high,
                                          const Vector& start);

}  // namespace rehearse::optim
