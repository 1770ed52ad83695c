#pragma once

#include <string>
#include <vector>

#include "rehearse/core/options.hpp"

namespace rehearse::apps {

/// The width in columns of the terminal on standard output; 120 if it is no terminal.
std::size_t terminal_width();

/// A table with name, default, published value if it differs, allowed values and help of each option, wrapped. Wider
/// than `width` only where names leave no room.
std::string options_table(const std::vector<Field>& fields, std::size_t width);

}  // namespace rehearse::apps
