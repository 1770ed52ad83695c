#include "rehearse/campaign/folder_name.hpp"

#include <cctype>
#include <string_view>

#include <fmt/format.h>

namespace rehearse::campaign {

std::string folder_name(const experiment::Spec& spec, const std::string& variant) {
  std::string name = fmt::format("{}-{}-{}-", spec.scenario, spec.learner, spec.prior.empty() ? "none" : spec.prior);
  if (!variant.empty()) name += variant + "-";
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view("._,=+-").find(c) == std::string::npos)
      c = '_';
  return name + fmt::to_string(spec.seed);
}

}  // namespace rehearse::campaign
