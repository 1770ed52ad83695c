#pragma once

#include <string>
#include <vector>

#include "rehearse/core/options.hpp"

namespace rehearse::apps {

/// Columns of the terminal that standard output is; 120 where it is none.
std::size_t terminal_width();

/// Name, default, what is published where that is another value, the values allowed, and what it does, below one
/// another and wrapped. Wider than `width` only where names leave no room.
std::string options_table(const std::vector<Field>& fields, std::size_t width);

}  // namespace rehearse::apps
