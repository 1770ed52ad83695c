#include "rehearse/experiment/preset.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/files/toml_reader.hpp"

namespace rehearse::experiment {
namespace {

constexpr std::int64_t kPresetFormat = 1;

std::vector<FileOption> options_in(const toml::table* table, files::FileViolations& violations) {
  std::vector<FileOption> options;
  if (!table) return options;
  for (const auto& [key, node] : files::leaves(*table)) {
    if (const auto text = files::text_of(key, *node, violations))
      options.push_back({key, *text, files::line_of(*node)});
  }
  return options;
}

/// True if the catalogue has this scenario or learner (`there`), or names it as one that the build leaves out.
bool is_known(const Catalogue& catalogue, const std::string& name, bool there) {
  return there || catalogue.left_out(name);
}

}  // namespace

Preset::Preset(std::string_view text, std::string source) : source_(std::move(source)) {
  const toml::table file = files::parse_toml(text, source_);
  files::FileViolations violations(source_);
  files::TomlReader reader(file, "", violations);
  const toml::node* format = reader.take("format");
  if (!format || format->value<std::int64_t>() != kPresetFormat)
    violations.add(format ? files::line_of(*format) : 0,
                   fmt::format("a preset begins with format = {}", kPresetFormat));
  reader.take("title", title_);
  parts_.push_back({.options = options_in(reader.take_table("set"), violations)});
  const toml::node* parts = reader.take("for");
  if (parts && !parts->is_array_of_tables()) reader.wrong("for", "parts for some runs are written as [[for]]");
  if (parts && parts->is_array_of_tables())
    for (const toml::node& node : *parts->as_array()) {
      files::TomlReader part(*node.as_table(), "[[for]]", violations);
      Part& added = parts_.emplace_back(Part{.line = files::line_of(node)});
      part.take("scenarios", added.scenarios);
      part.take("learners", added.learners);
      added.options = options_in(part.take_table("set"), violations);
      part.finish();
    }
  reader.finish();
  violations.throw_if_any();
}

std::vector<FileOption> Preset::options(const std::string& scenario, const std::string& learner) const {
  std::vector<FileOption> options;
  for (const Part& part : parts_)
    if ((part.scenarios.empty() || is_among(scenario, part.scenarios)) &&
        (part.learners.empty() || is_among(learner, part.learners)))
      options.insert(options.end(), part.options.begin(), part.options.end());
  return options;
}

std::vector<std::string> Preset::unknown_names(const Catalogue& catalogue) const {
  std::vector<std::string> lines;
  for (const Part& part : parts_) {
    for (const std::string& name : part.scenarios)
      if (!is_known(catalogue, name, catalogue.scenario(name) != nullptr))
        lines.push_back(files::in_file(source_, part.line, catalogue.why_missing("scenario", name)));
    for (const std::string& name : part.learners)
      if (!is_known(catalogue, name, catalogue.learner(name) != nullptr))
        lines.push_back(files::in_file(source_, part.line, catalogue.why_missing("learner", name)));
  }
  return lines;
}

Preset find_preset(const Catalogue& catalogue, const std::string& name_or_file) {
  if (name_or_file.ends_with(".toml")) return {files::read_file(name_or_file, files::Links::follow), name_or_file};
  std::vector<std::string> known;
  for (const NamedText& preset : catalogue.presets) {
    if (preset.name == name_or_file) return {preset.text, fmt::format("presets/{}.toml", preset.name)};
    known.push_back(preset.name);
  }
  throw InvalidInput(unknown_name("preset", name_or_file, known) + "; a file is named with its .toml");
}

std::optional<Preset> default_preset(const Catalogue& catalogue, const std::string& scenario) {
  for (const NamedText& preset : catalogue.default_presets)
    if (preset.name == scenario) return Preset(preset.text, fmt::format("presets/defaults/{}.toml", scenario));
  return std::nullopt;
}

}  // namespace rehearse::experiment
