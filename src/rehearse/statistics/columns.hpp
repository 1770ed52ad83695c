#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::statistics {

/// Statistics of each column, of what is finite in it; NaN where nothing is.
Vector column_means(const Matrix& columns);
Vector column_deviations(
    const Matrix& columns);  // their squares estimate variances without bias; NaN of one value, too
Vector column_quantiles(const Matrix& columns, double fraction);  // as those of quantiles.hpp
Vector column_root_mean_squares(const Matrix& columns);

}  // namespace rehearse::statistics
