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
  const auto is_named = [&](const FileOption& option) {  // by the last part of its name at least
    return violation.find(option.key.substr(option.key.rfind('.') + 1)) != std::string::npos;
  };
  for (const bool named : {true, false})  // to resolve a spec takes time, and those that it names are likely
    for (const FileOption& option : options)
      if (is_named(option) == named && has_violation(catalogue, with_options(bare, {option}), violation))
        return &option;
  return nullptr;
}

}  // namespace rehearse::experiment
