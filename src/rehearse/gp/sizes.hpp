#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::gp {

/// Throws InvalidInput "gp NAME = value, must be bound" unless they are equal. A comparison of integers.
void require_size(const char* name, Index value, Index bound);

/// The same of a matrix: "gp NAME is 3 × 2, must be 3 × 4".
void require_shape(const char* name, Index rows, Index columns, Index expected_rows, Index expected_columns);

}  // namespace rehearse::gp
