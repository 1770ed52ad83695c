#pragma once

#include <optional>

#include "rehearse/experiment/spec.hpp"

namespace rehearse::experiment {

/// Mean return of the policy θ over the scenario's `evaluations` episodes, on a plant made for them and from random
/// streams of their own: the trial, and whatever follows it, never notices. Empty if the scenario asks for none.
/// Throws what the plant throws.
std::optional<double> expected_return(const Resolved& resolved, Index trial, const Vector& theta);

}  // namespace rehearse::experiment
