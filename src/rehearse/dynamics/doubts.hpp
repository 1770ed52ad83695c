#pragma once

#include "rehearse/dynamics/phi_posterior.hpp"

namespace rehearse::dynamics {

/// PhiPosterior::doubts.
std::vector<std::string> doubts_of(const PhiPosterior& posterior);

}  // namespace rehearse::dynamics
