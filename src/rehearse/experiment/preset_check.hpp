#pragma once

#include <string>
#include <vector>

#include "rehearse/experiment/preset.hpp"

namespace rehearse::experiment {

/// "SOURCE: line N: …" for every option of a preset that the run `spec` cannot have and every name that the catalogue
/// has not; a preset without a word on such runs is wrong, too.
std::vector<std::string> violations(const Preset& preset, const Catalogue& catalogue, const Spec& spec);

/// The spec with those options of such a preset that are for its runs, after its own. Throws InvalidInput.
Spec with_preset(const Catalogue& catalogue, const Spec& spec, const std::string& name_or_file);

}  // namespace rehearse::experiment
