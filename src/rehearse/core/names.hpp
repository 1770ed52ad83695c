#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace rehearse {

inline bool is_among(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace rehearse
