#pragma once

#include <string>

#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::experiment {

/// Says of a complete spec for which memory did not suffice which sizes it asks for: the largest three among the whole
/// numbers that are not the defaults, or among all of them if there are none.
std::string not_enough_memory(const Catalogue& catalogue, const Spec& complete);

}  // namespace rehearse::experiment
