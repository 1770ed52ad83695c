#include "rehearse/experiment/spec_file.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/files.hpp"

namespace rehearse::experiment {
namespace {

constexpr std::int64_t kFormat = 1;
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

/// The text of a value, as `--set` takes it.
std::string text_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* integer = node.as_integer()) return fmt::to_string(integer->get());
  if (const auto* number = node.as_floating_point()) return to_text(number->get());
  throw InvalidInput(fmt::format("line {}: a value must be a number, true, false or text", node.source().begin.line));
}

/// Numbers and booleans as such where they come back as the same text, all else quoted.
std::string value(const std::string& text) {
  try {
    const toml::table parsed = toml::parse("v = " + text);
    if (parsed.size() == 1 && !parsed["v"].is_string() && text_of(*parsed.get("v")) == text) return text;
  } catch (const std::runtime_error&) {  // no TOML value: quoted
  }
  return in_quotes(text);
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

std::string section(const Spec& spec, std::string_view name) {
  std::string lines;
  for (const auto& [key, text] : spec.options)
    if (key.starts_with(fmt::format("{}.", name)))
      lines += fmt::format("{} = {}\n", dotted_key(key.substr(name.size() + 1)), value(text));
  return lines.empty() ? lines : fmt::format("\n[{}]\n{}", name, lines);
}

/// An option and where it stands: a TOML table does not keep the order of its keys.
struct Option {
  std::uint32_t line, column;
  std::string key, text;
};

void read_options(const toml::table& table, const std::string& prefix, std::vector<Option>& options) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + "." + std::string(key.str());
    if (const auto* nested = node.as_table())
      read_options(*nested, name, options);
    else
      options.push_back({node.source().begin.line, node.source().begin.column, name, text_of(node)});
  }
}

void add_in_order(std::vector<Option> options, Spec& spec) {
  std::sort(options.begin(), options.end(),
            [](const Option& a, const Option& b) { return std::tie(a.line, a.column) < std::tie(b.line, b.column); });
  for (Option& option : options) spec.options.emplace_back(std::move(option.key), std::move(option.text));
}

void check_format(const toml::table& file) {
  if (!file.contains("format") || !file["run"].is_table())
    throw InvalidInput("not a spec: it needs `format` and [run]");
  const std::int64_t format = file["format"].value_or(std::int64_t{0});
  if (format != kFormat)
    throw InvalidInput(
        fmt::format("format {} is that of another version of Rehearse, this one reads {}", format, kFormat));
}

void read_run(const toml::table& run, Spec& spec) {
  Violations violations;
  for (const auto& [key, node] : run) {
    const std::string name(key.str()), text = text_of(node);
    if (name == "scenario")
      spec.scenario = text;
    else if (name == "learner")
      spec.learner = text;
    else if (name == "prior")
      spec.prior = text;
    else if (!set_field([&](FieldVisitor& v) { spec.fields(v); }, name, text))
      violations.add(fmt::format("line {}: unknown key '{}' in [run]", node.source().begin.line, name));
  }
  violations.throw_if_any();
}

Spec read(std::string_view text) {
  const toml::table file = toml::parse(text);
  check_format(file);
  Spec spec;
  std::vector<Option> options;
  for (const auto& [key, node] : file) {
    const std::string name(key.str());
    const bool section = std::find(kSections.begin(), kSections.end(), name) != kSections.end() && node.is_table();
    if (name == "run")
      read_run(*node.as_table(), spec);
    else if (section)
      read_options(*node.as_table(), name, options);
    else if (name != "format")
      throw InvalidInput(fmt::format("line {}: unknown table or key '{}'", node.source().begin.line, name));
  }
  add_in_order(std::move(options), spec);
  return spec;
}

}  // namespace

std::string to_toml(const Spec& spec) {
  std::string text = fmt::format(
      "# A run of Rehearse, complete: `rehearse learn` of this file gives the same trials.csv.\n"
      "format = {}\n\n[run]\nscenario = {}\nlearner = {}\n",
      kFormat, in_quotes(spec.scenario), in_quotes(spec.learner));
  if (!spec.prior.empty()) text += fmt::format("prior = {}\n", in_quotes(spec.prior));
  text += fmt::format("trials = {}\nseed = {}\n", spec.trials, spec.seed);
  for (std::string_view name : kSections) text += section(spec, name);
  return text;
}

Spec from_toml(std::string_view text, const std::string& source_name) {
  try {
    return read(text);
  } catch (const toml::parse_error& error) {
    throw InvalidInput(fmt::format("{}: line {}: {}", source_name, error.source().begin.line, error.description()));
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: {}", source_name, error.what()));
  }
}

std::uint64_t fingerprint(Spec spec) {
  spec.trials = 0;
  return checksum(to_toml(spec));
}

}  // namespace rehearse::experiment
