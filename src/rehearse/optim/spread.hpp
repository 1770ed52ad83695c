#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// Point i = 0, 1, … of a sequence that fills the unit cube evenly, however many are taken; the first is its centre
/// (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences": the additive recurrence with the
/// generalised golden ratio).
Vector spread_point(Index dimensions, Index i);

}  // namespace rehearse::optim
