#pragma once

#include <algorithm>
#include <cmath>

#include "rehearse/core/types.hpp"

namespace rehearse::moments {

/// The step of differences of a prior by an input that is v. Second differences of a prior that is exact up to 1e-10
/// are off by 1e-4 then, those of one that is exact up to rounding by 1e-9; a third derivative of 1 adds 1e-6.
inline double prior_step(double v) { return 1e-3 * std::max(1.0, std::abs(v)); }

inline Vector prior_steps(const ConstVectorView& point) { return point.unaryExpr(&prior_step); }

}  // namespace rehearse::moments
