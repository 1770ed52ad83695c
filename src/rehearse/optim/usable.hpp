#pragma once

#include <cmath>
#include <limits>

namespace rehearse::optim {

/// The value of what has none that is finite: worse than all.
inline constexpr double kWorst = -std::numeric_limits<double>::infinity();

inline double usable(double value) { return std::isfinite(value) ? value : kWorst; }

}  // namespace rehearse::optim
