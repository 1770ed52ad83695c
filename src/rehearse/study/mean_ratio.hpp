#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::study {

/// The geometric mean of the ratios errors / of, entry by entry (of one size), where both are above 0. An error that is
/// not finite, as of a forecast that failed, counts as e¹⁰ times. NaN where nothing can be compared.
double mean_ratio(const ConstMatrixView& errors, const ConstMatrixView& of);

}  // namespace rehearse::study
