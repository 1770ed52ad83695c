#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace rehearse::apps {

/// Foreign text made safe for a terminal: every control character but the ends of lines is escaped, as \\x1b.
std::string printable(std::string_view text);

/// Prints on standard output, made printable. All foreign text is printed by it, except JSON, which programs read.
template <class... Arguments>
void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::print("{}", printable(fmt::format(format, std::forward<Arguments>(arguments)...)));
}

/// Writes to standard error; what cannot be written, as on a full disk, is lost: it is no reason to end the work.
void put_error(const std::string& text);

/// Prints each line of the message on standard error, made printable.
void complain(std::string_view message);

}  // namespace rehearse::apps
