#pragma once
// Which line of a file is to blame for what is wrong with a spec.

#include <string>
#include <vector>

#include "rehearse/experiment/spec.hpp"

namespace rehearse::experiment {

/// An option as a file has it.
struct FileOption {
  std::string key, text;
  Index line = 0;
};

Spec with_options(Spec spec, const std::vector<FileOption>& options);

/// Whether `resolve` finds this violation.
bool has_violation(const Catalogue& catalogue, const Spec& spec, const std::string& violation);

/// The first option that causes this violation without the others, too, or null.
const FileOption* cause(const Catalogue& catalogue, const Spec& bare, const std::vector<FileOption>& options,
                        const std::string& violation);

}  // namespace rehearse::experiment
