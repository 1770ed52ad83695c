#include "rehearse/experiment/location.hpp"

#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment {

bool has_violation(const Catalogue& catalogue, const Spec& spec, const std::string& violation) {
  try {
    resolve(catalogue, spec);
    return false;
  } catch (const InvalidInput& error) {
    return is_among(violation, error.violations());
  }
}

const FileOption* cause(const Catalogue& catalogue, const Spec& bare, const std::vector<FileOption>& options,
                        const std::string& violation) {
  for (const FileOption& option : options)
    if (has_violation(catalogue, with_options(bare, {option}), violation)) return &option;
  return nullptr;
}

}  // namespace rehearse::experiment
