#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace rehearse {

inline bool is_among(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// True if a name consists of letters, digits, - and _: folders are named after robots, priors and learners.
inline bool is_word(const std::string& name) {
  const auto is_part = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_part);
}

/// The text with each capital letter of ASCII as a small one.
inline std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

/// The unit behind a number: " kg"; empty without one.
inline std::string unit_text(const std::string& unit) { return unit.empty() ? "" : " " + unit; }

/// "q1 [rad]", as files and tables head a column.
inline std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

/// A folder name that every file system accepts: other characters become _.
inline std::string folder_name_of(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && std::string_view("._,=+-").find(c) == std::string::npos)
      c = '_';
  return name;
}

}  // namespace rehearse
