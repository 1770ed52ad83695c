#pragma once

#include <string>
#include <vector>

#include "rehearse/core/feature_map.hpp"
#include "rehearse/moments/moment_term.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::moments {

/// The means of GPs that were learned elsewhere, of (features of the state, actions), as a prior without parameters
/// (Cutler 2015). terms: of the changes of all states.
prior::Prior network_prior(std::string name, FeatureMap features, std::vector<MomentTerm> terms);

}  // namespace rehearse::moments
