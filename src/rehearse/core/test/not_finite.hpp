#pragma once
// Numbers that are not finite.

#include <limits>

namespace rehearse {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

}  // namespace rehearse
