#include "rehearse/report/json_shape.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::report {
namespace {

void compare_shape(const Json& json, const Json& example, const std::string& where, Violations& violations);

const char* kind_of(const Json& example) {
  return example.is_object()    ? "an object"
         : example.is_array()   ? "a list"
         : example.is_boolean() ? "true or false"
         : example.is_number()  ? "a number"
                                : "a text";
}

bool same_kind(const Json& json, const Json& example) {
  return example.is_number() ? json.is_number() : json.type() == example.type();
}

/// The first wrong element of a list stands for all: they mostly have the same fault.
void compare_elements(const Json& list, const Json& example, const std::string& where, Violations& violations) {
  const std::size_t before = violations.list().size();
  for (std::size_t i = 0; i < list.size() && violations.list().size() == before; ++i)
    compare_shape(list[i], example, fmt::format("{}[{}]", where, i), violations);
}

void compare_keys(const Json& object, const Json& example, const std::string& where, Violations& violations) {
  for (const auto& [name, part] : example.items()) {
    const bool optional = name.ends_with('?');
    const std::string key = optional ? name.substr(0, name.size() - 1) : name;
    const auto found = object.find(key);
    if (optional && (found == object.end() || found->is_null())) continue;
    compare_shape(found == object.end() ? Json() : *found, part, where.empty() ? key : where + '.' + key, violations);
  }
}

void compare_shape(const Json& json, const Json& example, const std::string& where, Violations& violations) {
  if (!same_kind(json, example)) return violations.add(fmt::format("{} must be {}", where, kind_of(example)));
  if (example.is_array()) compare_elements(json, example.front(), where, violations);
  if (example.is_object()) compare_keys(json, example, where, violations);
}

}  // namespace

void check_shape(const Json& json, const Json& example) {
  Violations violations;
  compare_shape(json, example, "", violations);
  violations.throw_if_any();
}

}  // namespace rehearse::report
