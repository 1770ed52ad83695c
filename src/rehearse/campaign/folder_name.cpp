#include "rehearse/campaign/folder_name.hpp"

#include <fmt/format.h>

#include "rehearse/core/names.hpp"

namespace rehearse::campaign {

std::string folder_name(const experiment::Spec& spec, const std::string& variant) {
  std::string name = fmt::format("{}-{}-{}-", spec.scenario, spec.learner, spec.prior.empty() ? "none" : spec.prior);
  if (!variant.empty()) name += variant + "-";
  return folder_name_of(name + fmt::to_string(spec.seed));
}

}  // namespace rehearse::campaign
