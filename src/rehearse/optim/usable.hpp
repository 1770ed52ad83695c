#pragma once

#include <cmath>

#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// The value of what has none that is finite: worse than all.
inline constexpr double kWorst = -kInf;

inline double usable(double value) { return std::isfinite(value) ? value : kWorst; }

}  // namespace rehearse::optim
