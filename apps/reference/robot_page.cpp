#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "apps/reference/pages.hpp"

namespace rehearse::apps {
namespace {

using Json = nlohmann::ordered_json;  // keys in the order of the file

constexpr const char* kIntroduction = R"(# Keys of a robot's file

This page has every key of a robot's file, with what it may be.

[A robot of your own](own-robot.md) explains them, with examples. A formula is a text in quotes, or a number
([grammar](own-robot.md#formulas)). NAME is a name that you give, or that of a state, an action or a parameter.
`rehearse list --schema` writes the same for editors that complete and check keys.

Made by `scripts/published` from `schemas/robot.json`.

## Before all tables
)";

constexpr const char* kHead = "\n| key | value | what it is | default |\n|---|---|---|---|\n";

/// The kinds that a value may have.
std::vector<Json> alternatives(const Json& node) {
  if (!node.contains("anyOf")) return {node};
  std::vector<Json> all;
  for (const Json& one : node.at("anyOf"))
    for (Json& inner : alternatives(one)) all.push_back(std::move(inner));
  return all;
}

bool is_table(const Json& node) { return node.contains("properties"); }

bool is_by_name(const Json& node) {
  return node.contains("additionalProperties") && node.at("additionalProperties").is_object();
}

std::string bounds_of(const Json& node) {
  std::vector<std::string> bounds;
  for (const auto& [key, sign] : {std::pair{"exclusiveMinimum", ">"}, {"minimum", "≥"}, {"maximum", "≤"}})
    if (node.contains(key)) bounds.push_back(fmt::format("{} {}", sign, node.at(key).dump()));
  return bounds.empty() ? "" : fmt::format(" {}", fmt::join(bounds, ", "));
}

std::string value_of(const Json& node);

std::string list_of(const Json& node) {
  const std::string item = value_of(node.at("items"));
  const bool pair = node.value("minItems", 0) == 2 && node.value("maxItems", 0) == 2;
  if (pair) return fmt::format("[{0}, {0}]", item);
  const bool several = item.find(", or ") != std::string::npos;
  return several ? "list of those" : "list: " + item;
}

std::string one_value(const Json& node) {
  if (node.contains("$ref")) return "formula";
  if (node.contains("const")) return node.at("const").dump();
  if (node.contains("enum")) {
    std::vector<std::string> words;
    for (const Json& word : node.at("enum")) words.push_back("`" + word.get<std::string>() + "`");
    return fmt::format("{}", fmt::join(words, ", "));
  }
  const std::string type = node.at("type");
  if (type == "array") return list_of(node);
  if (is_by_name(node)) return value_of(node.at("additionalProperties")) + " by NAME";
  if (type == "string") return "text";
  if (type == "boolean") return "true or false";
  return (type == "integer" ? "whole number" : type == "object" ? "table" : type) + bounds_of(node);
}

std::string value_of(const Json& node) {
  std::vector<std::string> values;
  for (const Json& one : alternatives(node))
    if (const std::string value = one_value(one); std::find(values.begin(), values.end(), value) == values.end())
      values.push_back(value);
  return fmt::format("{}", fmt::join(values, ", or "));
}

std::string description_of(const Json& node) {
  std::vector<std::string> descriptions;
  const auto add = [&](const Json& from) {
    const std::string text = from.value("description", "");
    if (!text.empty() && std::find(descriptions.begin(), descriptions.end(), text) == descriptions.end())
      descriptions.push_back(text);
  };
  add(node);
  if (is_by_name(node))
    for (const Json& one : alternatives(node.at("additionalProperties"))) add(one);
  return fmt::format("{}", fmt::join(descriptions, "; "));
}

std::string default_of(const Json& node, bool required) {
  if (required) return "must be there";
  if (!node.contains("default")) return "none";
  const Json& value = node.at("default");
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// The rows of a table's keys, those of tables inside it after their own.
class Rows {
 public:
  void add_keys(const Json& table, const std::string& before) {
    const Json required = table.value("required", Json::array());
    for (const auto& [key, node] : table.at("properties").items())
      add(before + key, node, std::find(required.begin(), required.end(), key) != required.end());
  }

  void add(const std::string& key, const Json& node, bool required) {
    if (is_by_name(node)) {
      add_row(key + ".NAME", node.at("additionalProperties"), description_of(node), required);
      return;
    }
    add_row(key, node, description_of(node), required);
  }

  const std::string& text() const { return text_; }

 private:
  void add_row(const std::string& key, const Json& node, const std::string& description, bool required) {
    if (std::find(keys_.begin(), keys_.end(), key) != keys_.end()) return;  // of a list of the same tables
    keys_.push_back(key);
    text_ += fmt::format("| `{}` | {} | {} | {} |\n", key, value_of(node), description, default_of(node, required));
    for (const Json& one : alternatives(node)) {
      if (is_table(one)) add_keys(one, key + ".");
      if (one.contains("items"))
        for (const Json& item : alternatives(one.at("items")))
          if (is_table(item)) add_keys(item, key + ".");
    }
  }

  std::vector<std::string> keys_;
  std::string text_;
};

/// [reward], [[state]], [dynamics.NAME] or [define].
std::string section_of(const std::string& key, const Json& node, bool required) {
  const bool list = node.contains("items"), named = is_by_name(node) && is_table(node.at("additionalProperties"));
  const std::string head = list ? "[[" + key + "]]" : "[" + key + (named ? ".NAME]" : "]");
  Rows rows;
  if (list)
    rows.add_keys(node.at("items"), "");
  else if (named)
    rows.add_keys(node.at("additionalProperties"), "");
  else if (is_table(node))
    rows.add_keys(node, "");
  else
    rows.add("", node, false);
  std::string text = rows.text();
  if (const std::size_t at = text.find("`.NAME`"); at != std::string::npos) text.replace(at, 7, "`NAME`");
  std::string description = node.value("description", "");
  if (!description.empty()) description[0] = static_cast<char>(std::toupper(description[0]));
  return fmt::format("\n## `{}`\n\n{}{}.\n{}{}", head, description, required ? "; must be there" : "", kHead, text);
}

}  // namespace

std::string robot_page(const std::string& schema) {
  const Json file = Json::parse(schema);
  const Json& required = file.at("required");
  const auto must_be_there = [&](const std::string& key) {
    return std::find(required.begin(), required.end(), key) != required.end();
  };
  Rows first;
  std::string sections;
  for (const auto& [key, node] : file.at("properties").items())
    if (const std::string type = node.value("type", ""); type == "object" || type == "array")
      sections += section_of(key, node, must_be_there(key));
    else
      first.add(key, node, must_be_there(key));
  return kIntroduction + (kHead + first.text()) + sections;
}

}  // namespace rehearse::apps
