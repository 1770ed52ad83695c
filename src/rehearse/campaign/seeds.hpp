#pragma once

#include <vector>

#include <toml++/toml.h>

#include "rehearse/core/types.hpp"

namespace rehearse::campaign {

/// The seeds of a campaign file: a number, "FIRST-LAST", or a list of these. Throws InvalidInput.
std::vector<Index> seeds_of(const toml::node& node);

}  // namespace rehearse::campaign
