#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace rehearse {

/// Names as a sentence has them: "m, l, b"; where there are more than so many: "m, l and 3 more".
inline std::string list_of(const std::vector<std::string>& names, std::size_t most) {
  const std::size_t shown = std::min(names.size(), most);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) text += (i > 0 ? ", " : "") + names[i];
  return names.size() > shown ? text + " and " + std::to_string(names.size() - shown) + " more" : text;
}

}  // namespace rehearse
