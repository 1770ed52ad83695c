#include "rehearse/experiment/spec.hpp"

#include <fmt/format.h>

namespace rehearse::experiment {

std::string run_name(const Spec& spec) {
  return fmt::format("{}-{}-{}-{}", spec.scenario, spec.learner, spec.prior.empty() ? "none" : spec.prior, spec.seed);
}

Spec with_options(Spec spec, const std::vector<FileOption>& options) {
  for (const FileOption& option : options) spec.options.emplace_back(option.key, option.text);
  return spec;
}

}  // namespace rehearse::experiment
