#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace rehearse::apps {

/// Text of others for a terminal: every control character but the ends of lines as \\x1b.
std::string printable(std::string_view text);

/// Prints on standard output, printable: every text of others goes this way, but JSON, which programs read.
template <class... Arguments>
void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::print("{}", printable(fmt::format(format, std::forward<Arguments>(arguments)...)));
}

/// One line on standard error for each line of the message, printable.
void complain(std::string_view message);

}  // namespace rehearse::apps
