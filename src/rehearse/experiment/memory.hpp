#pragma once

#include <string>

#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::experiment {

/// A message for a spec that needs too much memory: its three largest whole numbers that are not defaults, or of all
/// whole numbers if there are none.
std::string not_enough_memory(const Catalogue& catalogue, const Spec& complete);

}  // namespace rehearse::experiment
