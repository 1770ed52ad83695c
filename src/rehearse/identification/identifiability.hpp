#pragma once

#include "rehearse/identification/phi_posterior.hpp"

namespace rehearse::identification {

/// PhiPosterior::warnings.
std::vector<std::string> identifiability_warnings(const PhiPosterior& posterior);

}  // namespace rehearse::identification
