#pragma once

#include "rehearse/identification/fit_problem.hpp"
#include "rehearse/identification/kinds.hpp"

namespace rehearse::identification {

/// The φ and kernels of the highest score by turns: φ with the kernels held, a least-squares problem, and kernels with
/// φ held, until a turn gains nothing. From the given φ and that of the least squares on a part of the rows;
/// what they lead to goes on, on more and more rows. Every combination of the discrete parameters is tried. The maximum
/// of the nested search or a higher one, from some 150 rows on in a fraction of the time (docs/performance.md).
Fit search_by_turns(const GpMi& kind, const FitProblem& problem, const WarmStart& start);

}  // namespace rehearse::identification
