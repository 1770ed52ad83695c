#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::statistics {

/// Statistics of each column, of what is finite in it; NaN where nothing is. Squares of deviations estimate variances
/// without bias, and of one value there is none (NaN). Quantiles are those of quantiles.hpp.
Vector column_means(const Matrix& columns);
Vector column_deviations(const Matrix& columns);
Vector column_quantiles(const Matrix& columns, double fraction);
Vector column_root_mean_squares(const Matrix& columns);

}  // namespace rehearse::statistics
