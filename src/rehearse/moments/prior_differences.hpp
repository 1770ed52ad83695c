#pragma once

#include <algorithm>
#include <cmath>

#include "rehearse/core/types.hpp"

namespace rehearse::moments {

/// The step of first differences of a prior by an input that is v: as dynamics/dynamics_model.cpp.
inline double first_step(double v) { return 1e-4 * std::max(1.0, std::abs(v)); }

/// The same where second differences are taken, too. Those of a prior that is exact up to 1e-10 are off by 1e-4 then,
/// those of one that is exact up to rounding by 1e-9; a fourth derivative of 1 adds 1e-7.
inline double second_step(double v) { return 1e-3 * std::max(1.0, std::abs(v)); }

}  // namespace rehearse::moments
