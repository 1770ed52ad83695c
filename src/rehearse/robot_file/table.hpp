#pragma once
// One table of a robot's file: takes formulas, numbers by name and lists of tables. For the sources of this room.

#include <optional>
#include <string>
#include <vector>

#include "rehearse/expression/formulas.hpp"
#include "rehearse/files/toml_reader.hpp"
#include "rehearse/robot_file/robot.hpp"

namespace rehearse::robot_file {

class Table {
 public:
  Table(const toml::table& table, const std::string& where, files::FileViolations& violations)
      : table_(table), where_(where), violations_(violations), reader_(table, where, violations) {}

  files::TomlReader& reader() { return reader_; }
  void wrong(const std::string& key, const std::string& message) { reader_.wrong(key, message); }
  void finish() { reader_.finish(); }

  Formula formula(const std::string& key);                // text or a number; empty: it is not there
  std::vector<Formula> formulas(const std::string& key);  // a list of them, or one
  Definitions definitions(const std::string& key);        // a table of them
  void name(std::string& name, expression::Formulas& taken, const char* none);  // that formulas can use
  void unit(std::string& unit);                                                 // that headers of tables can have
  bool number(const std::string& key, double& value, Bound bound = {});
  bool interval(const std::string& key, Interval& value);

  /// The tables of a table, or of a list of tables, in the order of the file, under their names; empty: none is there.
  struct Part {
    std::string name;
    const toml::table* table;
  };
  std::vector<Part> tables(const std::string& key);
  std::vector<const toml::table*> list(const std::string& key);

 private:
  Formula formula_of(const std::string& key, const toml::node& node);

  const toml::table& table_;
  std::string where_;
  files::FileViolations& violations_;
  files::TomlReader reader_;
};

/// Adds a violation unless the program has a function of that name, or does without.
template <class Function>
void require_function(const Functions& functions, const std::map<std::string, Function>& known, const std::string& name,
                      Index line, files::FileViolations& violations) {
  if (!functions.only_look && !known.contains(name)) violations.add(line, missing_function(name));
}

/// Two numbers, [low, high], in whatever order; empty: the node is something else.
std::optional<Interval> pair_of(const toml::node& node);

/// Keys and values of a table in the order of the file.
std::vector<std::pair<std::string, const toml::node*>> in_order(const toml::table& table);

}  // namespace rehearse::robot_file
