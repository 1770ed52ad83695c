#pragma once
// Names for the known combinations of parameters that the data cannot separate.

#include <string>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::identification {

/// Sums and products that are the same at all these points (parameters × points), as "m1 + m2 = 1.24", "m2·r2 = 0.105"
/// or "I1 + 0.09·m2 = 0.111": as many of parameters − `unknown` or more as are so simple.
std::vector<std::string> known_combinations(const std::vector<std::string>& names, const Matrix& points, Index unknown);

}  // namespace rehearse::identification
