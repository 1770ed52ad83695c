#pragma once

#include "rehearse/identification/phi_posterior.hpp"

namespace rehearse::identification {

/// PhiPosterior::doubts.
std::vector<std::string> doubts_of(const PhiPosterior& posterior);

}  // namespace rehearse::identification
