#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// Values with the names of their variables, for people: "v = 1, x = 2.5"; of more than `most` the first, and "…".
template <class Variable>
std::string row_text(const std::vector<Variable>& variables, const ConstVectorView& values, Index most) {
  const Index count = std::min(values.size(), static_cast<Index>(variables.size())), shown = std::min(count, most);
  std::vector<std::string> texts;
  for (Index i = 0; i < shown; ++i)
    texts.push_back(fmt::format("{} = {:.4g}", variables[static_cast<std::size_t>(i)].name, values(i)));
  if (count > shown) texts.emplace_back("…");
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace rehearse
