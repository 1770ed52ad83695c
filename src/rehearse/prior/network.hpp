#pragma once

#include <string>
#include <vector>

#include "rehearse/core/feature_map.hpp"
#include "rehearse/gp/moment_term.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::prior {

/// The means of GPs that were learned elsewhere, of (features of the state, actions), as a prior without parameters
/// (Cutler 2015). terms: of the changes of all states.
Prior network(std::string name, FeatureMap features, std::vector<gp::MomentTerm> terms);

}  // namespace rehearse::prior
