#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace rehearse {

inline bool is_among(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether a name is of letters, digits, - and _: folders are named after robots and learners.
inline bool is_word(const std::string& name) {
  const auto is_part = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_part);
}

/// "q1 [rad]", as files and tables head a column.
inline std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

}  // namespace rehearse
