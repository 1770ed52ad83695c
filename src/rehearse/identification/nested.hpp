#pragma once

#include "rehearse/identification/fit_problem.hpp"
#include "rehearse/identification/kinds.hpp"

namespace rehearse::identification {

/// The φ of the highest score by Subplex, the kernels fitted anew at every φ, from where the best φ so far had them
/// (Chatzilygeroudis 2018, Algorithm 2). It starts from the given φ, or from that of the least squares if this scores
/// higher and `kind` asks for it. Every combination of the discrete parameters is tried.
Fit search_nested(const GpMi& kind, const FitProblem& problem, const WarmStart& start);

}  // namespace rehearse::identification
