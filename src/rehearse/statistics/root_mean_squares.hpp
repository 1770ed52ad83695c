#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::statistics {

/// Root mean squares of columns, of what is finite in them; NaN where nothing is.
Vector root_mean_squares(const Matrix& columns);

}  // namespace rehearse::statistics
