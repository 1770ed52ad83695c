#include "rehearse/experiment/spec_file.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "rehearse/experiment/location.hpp"
#include "rehearse/files/checksum.hpp"
#include "rehearse/files/toml_reader.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment {
namespace {

constexpr std::string_view kComplete =
    "# A run of Rehearse, complete: `rehearse learn` of this file gives the same trials.csv.";
constexpr std::int64_t kSpecFormat = 1;
constexpr std::array<std::string_view, 3> kSections = {"scenario", "learner", "prior"};

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + '"';
}

/// Numbers and booleans as such where they come back as the same text, all else quoted.
std::string value(const std::string& text) {
  try {
    const toml::table parsed = files::parse_toml("v = " + text, "");
    if (parsed.size() == 1 && !parsed["v"].is_string() && files::text_of(*parsed.get("v")) == text) return text;
  } catch (const std::runtime_error&) {  // no TOML value: quoted
  }
  return in_quotes(text);
}

/// True if TOML would take the shorter of two dotted keys for a value and for a table.
bool excludes(const std::string& name, const std::string& other) {
  return name.starts_with(other + '.') || other.starts_with(name + '.');
}

std::string dotted_key(const std::string& name) {
  const auto bare = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; };
  std::string key;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = name.find('.', begin);
    const std::string part = name.substr(begin, end - begin);
    if (begin > 0) key += '.';
    key += !part.empty() && std::all_of(part.begin(), part.end(), bare) ? part : in_quotes(part);
  }
  return key;
}

/// "KEY = VALUE  # COMMENT", comments below one another.
std::string option_line(const std::string& option, const std::string& name, const Comments& comments) {
  constexpr int kColumn = 46;
  const auto found = comments.find(name);
  if (found == comments.end()) return option + '\n';
  std::string comment = found->second;
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  std::replace_if(comment.begin(), comment.end(), is_control, ' ');
  return fmt::format("{:<{}}  # {}\n", option, kColumn, comment);
}

std::string section(const Spec& spec, std::string_view name, const Comments& comments) {
  const std::string prefix = fmt::format("{}.", name);
  std::string lines;
  for (const auto& [key, text] : spec.options) {
    if (!key.starts_with(prefix)) continue;
    const bool whole = std::ranges::any_of(
        spec.options, [&](const auto& other) { return other.first.starts_with(prefix) && excludes(key, other.first); });
    const std::string own = key.substr(prefix.size());
    lines += option_line((whole ? in_quotes(own) : dotted_key(own)) + " = " + value(text), key, comments);
  }
  return lines.empty() ? lines : fmt::format("\n[{}]\n{}", name, lines);
}

void check_format(const toml::table& file, const std::string& source) {
  if (!file.contains("format") || !file["run"].is_table())
    throw InvalidInput(fmt::format("{}: not a spec: it needs `format` and [run]", source));
  const std::int64_t format = file["format"].value_exact<std::int64_t>().value_or(0);
  if (format != kSpecFormat)
    throw InvalidInput(fmt::format("{}: format {} is that of another version of Rehearse, this one reads {}", source,
                                   format, kSpecFormat));
}

void read_run(files::TomlReader run, Spec& spec) {
  run.take("scenario", spec.scenario);
  run.take("robot", spec.robot);
  run.take("learner", spec.learner);
  run.take("prior", spec.prior);
  run.take_fields([&](FieldVisitor& v) { spec.fields(v); });
  run.finish();
}

std::vector<FileOption> read_options(const toml::table& file, files::TomlReader& reader,
                                     files::FileViolations& violations) {
  std::vector<FileOption> options;
  for (const std::string_view section : kSections) reader.take_table(std::string(section));
  for (const auto& [key, node] : files::leaves(file)) {
    const std::string_view section = std::string_view(key).substr(0, key.find('.'));
    if (section.size() == key.size() || std::find(kSections.begin(), kSections.end(), section) == kSections.end())
      continue;
    if (const auto text = files::text_of(key, *node, violations))
      options.push_back({key, *text, files::line_of(*node)});
  }
  return options;
}

}  // namespace

std::string of_told_run(std::string toml) {
  if (toml.starts_with(kComplete))
    toml.replace(0, kComplete.size(),
                 "# A run of Rehearse that is told of its robot: `rehearse learn` of this file begins one that was "
                 "told nothing yet.");
  return toml;
}

std::string to_toml(const Spec& spec, const Comments& comments) {
  std::string text =
      fmt::format("{}\nformat = {}\n\n[run]\nscenario = {}\n", kComplete, kSpecFormat, in_quotes(spec.scenario));
  if (!spec.robot.empty()) text += option_line("robot = " + in_quotes(spec.robot), "robot", comments);
  text += fmt::format("learner = {}\n", in_quotes(spec.learner));
  if (!spec.prior.empty()) text += fmt::format("prior = {}\n", in_quotes(spec.prior));
  text += option_line(fmt::format("trials = {}", spec.trials), "trials", comments);
  text += option_line(fmt::format("until_solved = {}", spec.until_solved), "until_solved", comments);
  text += option_line(fmt::format("seed = {}", spec.seed), "seed", comments);
  if (!spec.start.empty()) text += option_line("start = " + in_quotes(spec.start), "start", comments);
  if (spec.told_by == ToldBy::measured) text += option_line("told_by = \"measured\"", "told_by", comments);
  for (std::string_view name : kSections) text += section(spec, name, comments);
  return text;
}

SpecFile::SpecFile(std::string_view text, const std::string& source) : source_(source) {
  const toml::table file = files::parse_toml(text, source);
  check_format(file, source);
  files::FileViolations violations(source);
  files::TomlReader reader(file, "", violations);
  reader.take("format");
  const toml::table& run = *reader.take_table("run");
  read_run(files::TomlReader(run, "[run]", violations), bare_);
  run_lines_[""] = files::line_of(run);
  for (const auto& [key, node] : run) run_lines_[std::string(key.str())] = files::line_of(node);
  options_ = read_options(file, reader, violations);
  reader.finish();
  violations.throw_if_any();
  spec_ = with_options(bare_, options_);
}

std::string SpecFile::located(const Catalogue& catalogue, const std::string& violation) const {
  if (!has_violation(catalogue, spec_, violation)) return violation;
  Index line = 0;
  if (has_violation(catalogue, bare_, violation))
    line = line_of_names(violation);
  else if (const FileOption* option = cause(catalogue, bare_, options_, violation))
    line = option->line;
  return files::in_file(source_, line, violation);
}

/// The line of the name that the violation quotes, or that of [run].
Index SpecFile::line_of_names(const std::string& violation) const {
  const auto is_quoted = [&](const std::string& name) {
    return !name.empty() && violation.find(fmt::format("'{}'", name)) != std::string::npos;
  };
  if (is_quoted(bare_.scenario)) return run_lines_.at("scenario");
  if (is_quoted(bare_.learner)) return run_lines_.at("learner");
  return run_lines_.at(is_quoted(bare_.prior) ? "prior" : "");
}

Spec from_toml(std::string_view text, const std::string& source_name) { return SpecFile(text, source_name).spec(); }

void require_readable(const Spec& spec, const std::string& text) {
  constexpr const char* kUnreadable = "a run of this spec could not be opened again: its spec.toml would ";
  std::optional<Spec> back;
  try {
    back = from_toml(text, "");
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}not be read: {}", kUnreadable, error.what()));
  }
  Violations violations;
  const auto name_missing = [&](const Spec& of, const Spec& other, const char* how) {
    for (const auto& option : of.options)
      if (std::ranges::find(other.options, option) == other.options.end())
        violations.add(fmt::format("{}{} {} = {}", kUnreadable, how, option.first, option.second));
  };
  name_missing(spec, *back, "lack");
  name_missing(*back, spec, "have");
  violations.require(to_toml(*back) == to_toml(spec), fmt::format("{}be that of another one", kUnreadable));
  violations.throw_if_any();
}

std::uint64_t fingerprint(const Spec& spec) { return files::checksum(to_toml(spec.without_end())); }

}  // namespace rehearse::experiment
