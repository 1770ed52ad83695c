#include "rehearse/robot_file/table.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace rehearse::robot_file {

std::vector<std::pair<std::string, const toml::node*>> in_order(const toml::table& table) {
  struct Entry {
    std::string name;
    const toml::node* node;
    toml::source_position at;
  };
  std::vector<Entry> entries;
  for (const auto& [key, node] : table) entries.push_back({std::string(key.str()), &node, key.source().begin});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.at.line, a.at.column) < std::tie(b.at.line, b.at.column);
  });
  std::vector<std::pair<std::string, const toml::node*>> result;
  for (const Entry& entry : entries) result.emplace_back(entry.name, entry.node);
  return result;
}

std::optional<Interval> pair_of(const toml::node& node) {
  const toml::array* pair = node.as_array();
  if (!pair || pair->size() != 2 || !pair->get(0)->is_number() || !pair->get(1)->is_number()) return {};
  return Interval{*pair->get(0)->value<double>(), *pair->get(1)->value<double>()};
}

Formula Table::formula_of(const std::string& key, const toml::node& node) {
  if (node.is_string() || node.is_number())
    if (std::string text = files::text_of(node); text.find_first_not_of(" \t\n") != std::string::npos)
      return {std::move(text), files::line_of(node)};
  violations_.add(files::line_of(node), fmt::format("{} must be a formula in quotes, or a number", key));
  return {};
}

Formula Table::formula(const std::string& key) {
  const toml::node* node = reader_.take(key);
  return node ? formula_of(key, *node) : Formula();
}

std::vector<Formula> Table::formulas(const std::string& key) {
  const toml::node* node = reader_.take(key);
  if (!node) return {};
  if (!node->is_array()) return {formula_of(key, *node)};
  std::vector<Formula> all;
  for (const toml::node& element : *node->as_array()) all.push_back(formula_of(key, element));
  if (all.empty()) wrong(key, fmt::format("{} must be a list of formulas", key));
  return all;
}

Definitions Table::definitions(const std::string& key) {
  Definitions definitions;
  if (const toml::table* table = reader_.take_table(key))
    for (const auto& [name, node] : in_order(*table)) definitions.emplace_back(name, formula_of(name, *node));
  return definitions;
}

void Table::name(std::string& name, expression::Formulas& taken, const char* none) {
  if (!reader_.take("name", name)) return wrong("name", none);
  try {
    taken.input(name, expression::Pace::always);
  } catch (const InvalidInput& error) {
    wrong("name", error.what());
  }
}

void Table::unit(std::string& unit) {
  std::string given;
  if (!reader_.take("unit", given)) return;
  const auto spoils = [](unsigned char c) { return std::iscntrl(c) != 0 || c == '[' || c == ']'; };
  if (std::ranges::any_of(given, spoils)) return wrong("unit", "unit must have no brackets and no control characters");
  unit = given;
}

bool Table::number(const std::string& key, double& value, Bound bound) {
  const bool there = table_.contains(key);
  reader_.take_fields([&](FieldVisitor& v) { v.number(key, value, "", bound); });
  return there;
}

bool Table::interval(const std::string& key, Interval& value) {
  const toml::node* node = reader_.take(key);
  if (!node) return false;
  const auto pair = pair_of(*node);
  if (!pair)
    wrong(key, fmt::format("{} must be [low, high]", key));
  else if (value = *pair; !(value.low < value.high))
    wrong(key, fmt::format("{} = [{}, {}], must be [low, high] with low < high", key, value.low, value.high));
  else if (!std::isfinite(value.low) || !std::isfinite(value.high))
    wrong(key, fmt::format("{} = [{}, {}], must be finite", key, value.low, value.high));
  return true;
}

std::vector<Table::Part> Table::tables(const std::string& key) {
  std::vector<Part> parts;
  if (const toml::table* table = reader_.take_table(key))
    for (const auto& [name, node] : in_order(*table)) {
      if (node->is_table())
        parts.push_back({name, node->as_table()});
      else
        violations_.add(files::line_of(*node), fmt::format("{}.{} must be a table: [{}.NAME]", key, name, key));
    }
  return parts;
}

std::vector<const toml::table*> Table::list(const std::string& key) {
  const toml::node* node = reader_.take(key);
  if (!node) return {};
  std::vector<const toml::table*> tables;
  if (!node->is_array_of_tables()) {
    wrong(key, fmt::format("each {} is a part of its own: [[{}]]", key, key));
    return tables;
  }
  for (const toml::node& part : *node->as_array()) tables.push_back(part.as_table());
  return tables;
}

}  // namespace rehearse::robot_file
