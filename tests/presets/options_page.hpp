#pragma once

#include <string>

#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::presets {

/// docs/options.md: the options of all learners, scenarios and runs, those for experts last.
std::string options_page(const experiment::Catalogue& catalogue);

}  // namespace rehearse::presets
