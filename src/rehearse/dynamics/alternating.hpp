#pragma once

#include "rehearse/dynamics/estimate.hpp"
#include "rehearse/dynamics/learn.hpp"

namespace rehearse::dynamics {

/// The φ and kernels of the highest score by turns: φ with the kernels held, a least-squares problem, and kernels with
/// φ held, until a turn gains nothing. From the given φ and that of the least squares on a part of the rows;
/// what they lead to goes on, on more and more rows. Every combination of the discrete parameters is tried. The maximum
/// of the nested search or a higher one, from some 150 rows on in a fraction of the time (docs/performance.md).
Estimate search_by_turns(const GpMi& kind, const Estimation& estimation, const WarmStart& start);

}  // namespace rehearse::dynamics
