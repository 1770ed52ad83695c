#pragma once

#include <optional>
#include <string>

#include "rehearse/core/types.hpp"

namespace rehearse::campaign {

/// Every `of`-th run of a campaign, from number `number` on: that of one of several processes that work in the same
/// folder and need not know of each other.
struct Share {
  Index number = 1, of = 1;
};

/// "3/20": number 3 of 20. None where the text is not K/N with K from 1 to N.
std::optional<Share> read_share(const std::string& text);

}  // namespace rehearse::campaign
