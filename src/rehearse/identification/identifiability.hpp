#pragma once

#include "rehearse/identification/phi_posterior.hpp"

namespace rehearse::identification {

/// Identifiability warnings, a sentence each: parameters that only together fit or do not, those that could be
/// nearly anything, and those at the end of their box; with the former what is known of them, if that is simple.
std::vector<std::string> identifiability_warnings(const PhiPosterior& posterior);

}  // namespace rehearse::identification
