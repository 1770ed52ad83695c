#pragma once
// The line of a file that causes a violation in a spec.

#include <string>
#include <vector>

#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment {

/// True if `resolve` finds this violation.
bool has_violation(const Catalogue& catalogue, const Spec& spec, const std::string& violation);

/// An option that causes this violation without the others, too, or null: the first that it names, else the first.
const FileOption* cause(const Catalogue& catalogue, const Spec& bare, const std::vector<FileOption>& options,
                        const std::string& violation);

}  // namespace rehearse::experiment
