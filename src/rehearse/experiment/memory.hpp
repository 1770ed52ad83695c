#pragma once

#include <string>

#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::experiment {

/// A message for a spec that needs too much memory: the sizes, three at most, that are most times their default. A size
/// is a number of things, a time (in control steps), or the horizon of a robot's file.
std::string not_enough_memory(const Catalogue& catalogue, const Spec& complete);

}  // namespace rehearse::experiment
