#include "rehearse/files/toml_reader.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/names.hpp"

namespace rehearse::files {
namespace {

/// The fields that stand without quotes, and what each must be.
class Unquoted final : public FieldVisitor {
 public:
  explicit Unquoted(const Fields& fields) { fields(*this); }
  std::map<std::string, const char*> must_be;

 protected:
  void visit(const std::string& name, double&, Bound) override { must_be[name] = "a number"; }
  void visit(const std::string& name, Index&, Bound) override { must_be[name] = "a whole number"; }
  void visit(const std::string& name, bool&) override { must_be[name] = "true or false"; }
  void visit(const std::string&, std::string&) override {}
  void visit(const std::string&, int&, const std::vector<std::string>&) override {}
};

}  // namespace

std::string in_file(const std::string& source, Index line, const std::string& message) {
  const std::string where = source.empty() ? "" : source + ": ";
  return line > 0 ? fmt::format("{}line {}: {}", where, line, message) : where + message;
}

void FileViolations::throw_if_any() const {
  Violations lines;
  for (const auto& [line, message] : list_) lines.add(in_file(source_, line, message));
  lines.throw_if_any();
}

namespace {

constexpr Index kDeepest = 256;  // tables in tables; the parser bounds arrays so, and recurses without a bound for keys

/// The place after the string whose opening quote is at `at`; one that is not closed ends with its line or the text.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool many_lines = text.substr(at, 3) == std::string(3, quote);
  const std::string closing(many_lines ? 3 : 1, quote);
  for (std::size_t i = at + closing.size(); i < text.size(); ++i) {
    if (!many_lines && text[i] == '\n') return i;
    if (text.substr(i, closing.size()) == closing) {
      i += closing.size();
      for (int more = 0; many_lines && more < 2 && i < text.size() && text[i] == quote; ++more) ++i;  // its own quotes
      return i;
    }
    if (quote == '"' && text[i] == '\\') ++i;
  }
  return text.size();
}

/// Refuses keys of more parts than the parser can take.
void check_depth(std::string_view text, const std::string& source) {
  Index line = 1, dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    std::size_t next = i + 1;
    if (c == '"' || c == '\'') next = end_of_string(text, i);
    if (c == '#') next = std::min(text.find('\n', i), text.size());
    if (std::string_view("\n,={}[]").find(c) != std::string_view::npos) dots = 0;
    if (c == '.' && ++dots >= kDeepest)
      throw InvalidInput(in_file(source, line, fmt::format("a key has more than {} parts", kDeepest)));
    line += std::ranges::count(text.substr(i, next - i), '\n');
    i = next;
  }
}

/// An error of the parser is in words of its grammar: this is what a person can write instead, or nothing.
std::string remedy(std::string_view error) {
  for (const char* kind : {"value:", "floating-point:", "boolean:", "decimal integer:",
                           "key-value pair: expected a comment"})  // NAME = m * l, unit = kg, dt_s = 5 ms
    if (error.starts_with(fmt::format("Error while parsing {}", kind)))
      return "; formulas, names and units stand in quotes";
  if (error.find("unescaped control characters other than TAB") != std::string_view::npos)
    return "; is the closing quote missing?";
  if (error.find("cannot redefine existing table") != std::string_view::npos)
    return "; where there are several tables of a kind, each is in double brackets, such as [[state]]";
  return "";
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& source) {
  check_depth(text, source);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw InvalidInput(in_file(source, error.source().begin.line,
                               fmt::format("{}{}", error.description(), remedy(error.description()))));
  }
}

Index line_of(const toml::node& node) { return static_cast<Index>(node.source().begin.line); }

std::string text_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* integer = node.as_integer()) return fmt::to_string(integer->get());
  if (const auto* number = node.as_floating_point()) return to_text(number->get());
  throw InvalidInput("a value must be a number, true, false or text");
}

std::optional<std::string> text_of(const std::string& key, const toml::node& node, FileViolations& violations) {
  try {
    return text_of(node);
  } catch (const InvalidInput& error) {
    violations.add(line_of(node), fmt::format("{}: {}", key, error.what()));
    return std::nullopt;
  }
}

std::vector<std::pair<std::string, const toml::node*>> leaves(const toml::table& table, const std::string& prefix) {
  std::vector<std::pair<std::string, const toml::node*>> all;
  for (const auto& [key, node] : table) {
    const std::string name = prefix.empty() ? std::string(key.str()) : fmt::format("{}.{}", prefix, key.str());
    if (const auto* nested = node.as_table()) {
      const auto inner = leaves(*nested, name);
      all.insert(all.end(), inner.begin(), inner.end());
    } else {
      all.emplace_back(name, &node);
    }
  }
  const auto position = [](const auto& leaf) {
    const toml::source_position& begin = leaf.second->source().begin;
    return std::tie(begin.line, begin.column);
  };
  std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return position(a) < position(b); });
  return all;
}

const toml::node* TomlReader::take(const std::string& key) {
  if (!is_among(key, known_)) known_.push_back(key);
  return table_.get(key);
}

void TomlReader::wrong(const std::string& key, const std::string& message) {
  const toml::node* node = table_.get(key);
  violations_.add(line_of(node ? *node : table_), message);
}

void TomlReader::take_fields(const Fields& fields) {
  const Unquoted unquoted(fields);
  for (const auto& [key, text] : list_fields(fields)) {
    const toml::node* node = take(key);
    if (!node) continue;
    const auto must_be = unquoted.must_be.find(key);
    if (node->is_string() && must_be != unquoted.must_be.end()) {
      wrong(key, fmt::format("{} = \"{}\", must be {}, without quotes", key, text_of(*node), must_be->second));
      continue;
    }
    if (!node->is_value()) {
      wrong(key, fmt::format("{} must be {}, not a {}", key,
                             must_be == unquoted.must_be.end() ? "text in quotes" : must_be->second,
                             node->is_array() ? "list" : "table"));
      continue;
    }
    try {
      set_field(fields, key, text_of(*node));
    } catch (const InvalidInput& error) {
      wrong(key, error.what());
    }
  }
}

bool TomlReader::take(const std::string& key, std::string& value) {
  const toml::node* node = take(key);
  if (!node) return false;
  if (const auto* text = node->as_string())
    value = text->get();
  else
    wrong(key, fmt::format("{} must be text in quotes", key));
  return true;
}

bool TomlReader::take(const std::string& key, std::vector<std::string>& names) {
  if (!take_words(key, names)) return false;
  const std::set<std::string> different(names.begin(), names.end());
  for (const std::string& name : different)
    if (std::ranges::count(names, name) > 1) wrong(key, fmt::format("{} names '{}' twice", key, name));
  return true;
}

bool TomlReader::take_words(const std::string& key, std::vector<std::string>& words) {
  const toml::node* node = take(key);
  if (!node) return false;
  std::vector<std::string> read;
  if (const auto* text = node->as_string()) read.push_back(text->get());
  if (const auto* list = node->as_array())
    for (const toml::node& element : *list)
      if (const auto* text = element.as_string()) read.push_back(text->get());
  const bool all_read = node->is_string() || (node->is_array() && node->as_array()->size() == read.size());
  if (!all_read || read.empty())
    wrong(key, fmt::format("{} must be a list of names in quotes", key));
  else
    words = std::move(read);
  return true;
}

const toml::table* TomlReader::take_table(const std::string& key) {
  const toml::node* node = take(key);
  if (node && !node->is_table()) wrong(key, fmt::format("{} must be a table", key));
  return node ? node->as_table() : nullptr;
}

void TomlReader::finish() {
  for (const auto& [key, node] : table_) {
    const std::string name(key.str());
    if (is_among(name, known_)) continue;
    const std::string place = where_.empty() ? "" : " in " + where_;
    violations_.add(static_cast<Index>(key.source().begin.line),
                    fmt::format("unknown key '{}'{}{} (known: {})", name, place, did_you_mean(name, known_),
                                known_.empty() ? "none" : fmt::format("{}", fmt::join(known_, ", "))));
  }
}

}  // namespace rehearse::files
