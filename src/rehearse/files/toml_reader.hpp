#pragma once
// Reading of TOML files that reports all errors at once, each with its line.

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <toml++/toml.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/options.hpp"

namespace rehearse::files {

/// "SOURCE: line N: MESSAGE"; without a line if that is 0, without a source if that is empty.
std::string in_file(const std::string& source, Index line, const std::string& message);

/// Violations found in a file.
class FileViolations {
 public:
  explicit FileViolations(std::string source) : source_(std::move(source)) {}

  /// line: from 1, or 0 if it is not about one. The same is kept once.
  void add(Index line, const std::string& message) { list_.emplace(line, message); }
  bool empty() const { return list_.empty(); }

  /// InvalidInput, "SOURCE: line N: MESSAGE" for each, in the order of the lines.
  void throw_if_any() const;

 private:
  std::string source_;
  std::set<std::pair<Index, std::string>> list_;
};

/// Parses, or throws InvalidInput with source and line.
toml::table parse_toml(std::string_view text, const std::string& source);

Index line_of(const toml::node& node);

/// The text of a value, as `--set` takes it. Throws InvalidInput if it is an array, a table or a date.
std::string text_of(const toml::node& node);

/// The same of a key; nothing, and a violation, where it is none.
std::optional<std::string> text_of(const std::string& key, const toml::node& node, FileViolations& violations);

/// Everything under a table that is no table itself, by dotted name ("PREFIX.a.b", without a prefix "a.b"), in the
/// order of the file, which a TOML table does not keep.
std::vector<std::pair<std::string, const toml::node*>> leaves(const toml::table& table, const std::string& prefix = "");

/// Takes the keys of one table; each `take` returns whether the key is there, and leaves the value alone if it is not
/// or is wrong.
class TomlReader {
 public:
  /// where: "[run]", for messages.
  TomlReader(const toml::table& table, std::string where, FileViolations& violations)
      : table_(table), where_(std::move(where)), violations_(violations) {}

  bool has(const std::string& key) const { return table_.contains(key); }
  Index line() const { return line_of(table_); }
  bool take(const std::string& key, std::string& value);
  bool take(const std::string& key, std::vector<std::string>& names);        // a list of texts, or one; none twice
  bool take_words(const std::string& key, std::vector<std::string>& words);  // likewise, and may repeat: a command
  void take_fields(const Fields& fields);                                    // with their bounds; texts alone in quotes
  const toml::node* take(const std::string& key);                            // null if it is not there
  const toml::table* take_table(const std::string& key);                     // null, too, if it is no table
  void wrong(const std::string& key, const std::string& message);

  /// A violation for every key that was not taken.
  void finish();

 private:
  const toml::table& table_;
  std::string where_;
  FileViolations& violations_;
  std::vector<std::string> known_;
};

}  // namespace rehearse::files
