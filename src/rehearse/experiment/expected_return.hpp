#pragma once

#include <optional>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/experiment/record.hpp"
#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment {

/// Mean return of the trial's policy over the scenario's `evaluations` episodes, on a plant made for them and from
/// random streams of their own: the trial, and whatever follows it, never notices. Empty if the scenario asks for none.
/// Asks the evaluator before every step whether to stop. Throws what the plant throws.
std::optional<double> expected_return(const Resolved& resolved, const TrialRecord& trial, const Evaluator& evaluator);

}  // namespace rehearse::experiment
