#include "rehearse/experiment/preset_check.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/experiment/location.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/files/toml_reader.hpp"

namespace rehearse::experiment {
namespace {

std::vector<std::string> said_of(const Catalogue& catalogue, const Spec& spec) {
  try {
    completed(catalogue, spec);
    return {};
  } catch (const InvalidInput& error) {
    return error.violations();
  }
}

}  // namespace

std::vector<std::string> violations(const Preset& preset, const Catalogue& catalogue, const Spec& spec) {
  std::vector<std::string> lines = preset.unknown_names(catalogue);
  const std::vector<FileOption> own = preset.options(spec.scenario, spec.learner);
  if (own.empty() && lines.empty())
    lines.push_back(files::in_file(
        preset.source(), 0, fmt::format("nothing is set for learner {} on scenario {}", spec.learner, spec.scenario)));
  const std::vector<std::string> before = said_of(catalogue, spec);
  for (const std::string& violation : said_of(catalogue, with_options(spec, own))) {
    if (is_among(violation, before)) continue;
    const FileOption* option = cause(catalogue, spec, own, violation);
    lines.push_back(files::in_file(preset.source(), option ? option->line : 0,
                                   fmt::format("{} (learner {} on {})", violation, spec.learner, spec.scenario)));
  }
  return lines;
}

Spec with_preset(const Catalogue& catalogue, const Spec& spec, const std::string& name_or_file) {
  const Preset preset = find_preset(catalogue, name_or_file);
  Violations found;
  found.add(violations(preset, catalogue, spec));
  found.throw_if_any();
  return with_options(spec, preset.options(spec.scenario, spec.learner));
}

}  // namespace rehearse::experiment
