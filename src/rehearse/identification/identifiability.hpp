#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rehearse/identification/phi_posterior.hpp"

namespace rehearse::identification {

/// The end of its box at which a parameter's value stands, within a thousandth of the box; empty elsewhere.
std::optional<double> end_at(const Parameter& parameter, double value);

/// Identifiability warnings, a sentence each: parameters that only together fit or do not, those that could be
/// nearly anything, and those at the end of their box; with the former what is known of them, if that is simple.
std::vector<std::string> identifiability_warnings(const PhiPosterior& posterior);

}  // namespace rehearse::identification
